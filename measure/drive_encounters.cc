// SPDX-License-Identifier: Apache-2.0
#include "measure/drive_encounters.h"

#include <algorithm>

#include "base/quantity.h"
#include "base/words.h"
#include "measure/encounter_scenario.h"
#include "run/scenario/override.h"

namespace floorproof {

namespace {

std::vector<FailureMode> Modes() {
  std::vector<FailureMode> modes;
  for (int i = 0; i < kNumFailureModes; ++i) modes.push_back(static_cast<FailureMode>(i));
  return modes;
}

}  // namespace

RobotCampaign EncountersOf(const std::string& robot, const std::vector<Override>& overrides) {
  return CampaignOf(
      robot, "encounters",
      [](const std::string& named, const RobotModel& model) {
        return EncounterScenario(named, model.spec, EncounterSensors(model));
      },
      overrides);
}

TextTable EncounterTable(const CampaignSummary& summary) {
  std::vector<TextColumn> columns = {{.heading = "Meeting", .wraps = true},
                                     {.heading = "Episodes", .right = true},
                                     {.heading = "Cleared", .right = true}};
  for (const FailureMode mode : Modes())
    columns.push_back({.heading = Words(Name(mode)), .right = true});
  const bool lost = std::ranges::any_of(summary.variants, [](const VariantSummary& variant) {
    return variant.errors > 0 || variant.not_planned > 0;
  });
  if (lost) columns.push_back({.heading = "No outcome"});
  TextTable table(std::move(columns));
  for (const VariantSummary& variant : summary.variants) {
    const auto share = [&](int k) {
      return variant.n == 0 ? std::string("–") : PercentText(static_cast<double>(k) / variant.n);
    };
    // The variant's name without the axis's.
    std::vector<TextCell> row = {variant.name.substr(variant.name.find('=') + 1),
                                 FixedText(variant.n, 0), share(variant.success)};
    for (const FailureMode mode : Modes()) {
      const auto rate = std::ranges::find(variant.failures, Name(mode), &FailureRate::name);
      row.emplace_back(share(rate == variant.failures.end() ? 0 : rate->k));
    }
    std::string none = variant.errors > 0 ? CountText(variant.errors, "error") : "";
    if (variant.not_planned > 0)
      none += (none.empty() ? "" : ", ") + FixedText(variant.not_planned, 0) + " not planned";
    if (lost) row.emplace_back(std::move(none));
    table.Add(std::move(row));
  }
  return table;
}

}  // namespace floorproof
