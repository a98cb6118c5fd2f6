// SPDX-License-Identifier: Apache-2.0
#include "measure/drive_encounters.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/quantity.h"
#include "measure/encounter_scenario.h"

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

std::string EncounterTable(const CampaignSummary& summary) {
  std::string text = fmt::format("  {:<20} {:>8} {:>9}", "meeting", "episodes", "cleared");
  for (const FailureMode mode : Modes()) text += fmt::format(" {:>12}", Name(mode));
  for (const VariantSummary& variant : summary.variants) {
    const auto share = [&](int k) {
      return variant.n == 0 ? std::string("-") : PercentText(static_cast<double>(k) / variant.n);
    };
    // The variant's name without the axis's.
    text += fmt::format("\n  {:<20} {:>8} {:>9}", variant.name.substr(variant.name.find('=') + 1),
                        variant.n, share(variant.success));
    for (const FailureMode mode : Modes()) {
      const auto rate = std::ranges::find(variant.failures, Name(mode), &FailureRate::name);
      text += fmt::format(" {:>12}", share(rate == variant.failures.end() ? 0 : rate->k));
    }
    if (variant.errors > 0) text += "  " + CountText(variant.errors, "error");
    if (variant.not_planned > 0) text += fmt::format("  {} not planned", variant.not_planned);
  }
  return text;
}

}  // namespace floorproof
