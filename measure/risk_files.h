// SPDX-License-Identifier: Apache-2.0
// What a robot's measured encounters say: risk_model.json and fmea_measured.yaml.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "env/scene/robot_model.h"
#include "measure/hazard_classes.h"
#include "measure/measured_fmea.h"
#include "planners/risk/rate_model.h"
#include "run/campaign/campaign_store.h"

namespace floorproof {

struct MeasuredDrive {
  std::string variant;
  std::uint64_t episode = 0;
};
struct MeasuredEncounters {
  std::vector<Encounter> encounters;  // each Encounter::drive is one of:
  std::vector<MeasuredDrive> drives;
};
// Of the campaign's counted episodes, variant after variant.
MeasuredEncounters AllEncounters(const CampaignStore& store);

// Fits the rates to all encounters of the campaign's counted episodes and writes
// fmea_measured.yaml. Returns none, and writes nothing, where no kind was met often enough. Throws
// InputError where the file cannot be written.
std::optional<RiskModel> FitRiskModel(const CampaignStore& store, const RobotModel& robot,
                                      const DamageLimits& limits,
                                      const std::filesystem::path& folder);
// Writes risk_model.json.
void WriteRiskModel(const RiskModel& model, const std::filesystem::path& folder);
// For people: how many kinds were fitted, and which were not; what was learned from plans.
std::vector<std::string> RiskModelLines(const RiskModel& model);

}  // namespace floorproof
