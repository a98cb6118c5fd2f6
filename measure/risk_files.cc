// SPDX-License-Identifier: Apache-2.0
#include "measure/risk_files.h"

#include <fmt/format.h>

#include <map>

#include "base/file_output.h"
#include "base/quantity.h"
#include "controllers/drive.h"
#include "env/scene/measured_block.h"
#include "measure/encounter_scenario.h"
#include "measure/fit_rates.h"
#include "measure/measured_fmea_yaml.h"
#include "measure/mirror_image.h"
#include "measure/risk_model_json.h"
#include "measure/shared_frailty.h"
#include "run/scenario/fmea_file.h"
#include "run/scenario/scenario_parts.h"

namespace floorproof {

MeasuredEncounters AllEncounters(const CampaignStore& store) {
  MeasuredEncounters all;
  for (const std::string& variant : store.Variants()) {
    std::optional<std::uint64_t> last;
    store.ForEachEncounter(variant, [&](std::uint64_t episode, const Encounter& encounter) {
      if (last != episode) all.drives.push_back({variant, episode});
      last = episode;
      all.encounters.push_back(encounter);
      all.encounters.back().drive = static_cast<int>(all.drives.size()) - 1;
    });
  }
  return all;
}

std::optional<RiskModel> FitRiskModel(const CampaignStore& store, const RobotModel& robot,
                                      const DamageLimits& limits,
                                      const std::filesystem::path& folder) {
  const RobotSpec& spec = robot.spec;
  const std::vector<Encounter> encounters = AllEncounters(store).encounters;
  RateFitOptions options;
  options.mirrored = IsMirrorImage(spec);
  options.holonomic = IsHolonomic(spec);
  RiskModel model = FitRates(
      encounters,
      {spec.name, spec.drive, spec.mass_kg, spec.clearance_m, ModelHash(robot.files, {})}, options);
  if (model.kinds.empty()) return std::nullopt;
  const MeasuredFmea fmea = MeasureFmea(FirstMeetings(encounters), ClassOfType(), spec.cruise_mps,
                                        ReadFmeaTables(BundledTables()), limits);
  WriteFileWhole(folder / "fmea_measured.yaml",
                 MeasuredFmeaYaml(fmea, spec.name, EncounterSensors(robot)));
  return model;
}

void WriteRiskModel(const RiskModel& model, const std::filesystem::path& folder) {
  WriteFileWhole(folder / "risk_model.json", RiskModelJson(model));
}

std::vector<std::string> RiskModelLines(const RiskModel& model) {
  std::vector<std::string> lines = {fmt::format("risk_model.json: rates of {} from {}",
                                                CountText(model.kinds.size(), "kind"),
                                                CountText(model.encounters, "encounter"))};
  for (const UnmeasuredKind& kind : model.unmeasured)
    lines.push_back(fmt::format("  {} {}: {}", kind.type, Name(kind.passage), kind.why));
  if (const CarryOver& carried = model.carry_over; carried.plans > 0)
    lines.push_back(fmt::format(
        "  of {} plans' {} drives {:.0f} were to fail by these rates and {} did: where rates "
        "come to 10 %, 30 %, 60 %, plans fail in {}, {}, {}",
        carried.plans, carried.drives, carried.expected, carried.failed,
        PercentText(carried.Of(0.1)), PercentText(carried.Of(0.3)), PercentText(carried.Of(0.6))));
  return lines;
}

}  // namespace floorproof
