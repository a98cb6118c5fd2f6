// SPDX-License-Identifier: Apache-2.0
// A robot's supervision as it is written: the keys `safety` and `mission`.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/config.h"
#include "base/input_files.h"
#include "controllers/supervision/safety_plan.h"

namespace floorproof {

// The mission that stands where none is named: it drives the scenario's plan.
inline constexpr std::string_view kBundledMission = "follow_plan";
std::filesystem::path BundledMission();

// `safety`, the key's map; nullptr: as it is by default. `root`: the mission's file, parsed. Throws
// InputError with file, line and key. Which monitors the robot can have is not asked yet.
SafetyPlan ReadSafety(const ConfigNode* safety, const ConfigNode& root);
ConfigNode SafetySchema();
// What a supervised robot is told whichever monitors watch it: whether it stands is asked of its
// wheels and its gyro. A lidar is more than a monitor is worth.
inline constexpr Reading kSupervisionNeeds[] = {Reading::kWheels, Reading::kImu, Reading::kPower};
// Takes away the monitors that go by what the robot is not told; and those that go by where it
// thinks it is, where that is the truth.
void KeepMonitorsOf(std::span<const Reading> told, SafetyPlan& plan);

// The key `safety` again, with every default stated.
ConfigNode WriteSafety(const SafetyPlan& plan);

}  // namespace floorproof
