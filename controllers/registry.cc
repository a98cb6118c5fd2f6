// SPDX-License-Identifier: Apache-2.0
// The tables of drives, estimators and trackers, made from their lists.
#include <algorithm>
#include <string>

#include "controllers/drive.h"
#include "controllers/estimator.h"
#include "controllers/tracker.h"

namespace floorproof {

#define FP_DRIVE(Class, name, help) std::unique_ptr<Drive> Make##Class();
#include "controllers/drives.inc"
#undef FP_DRIVE

#define FP_ESTIMATOR(Class, name, help) std::unique_ptr<Estimator> Make##Class();
#include "controllers/estimators.inc"
#undef FP_ESTIMATOR

#define FP_TRACKER(Class, name, help) std::unique_ptr<Tracker> Make##Class();
#include "controllers/trackers.inc"
#undef FP_TRACKER

std::span<const PluginEntry<Drive>> Drives() {
  static constexpr PluginEntry<Drive> kTable[] = {
#define FP_DRIVE(Class, name, help) {name, help, &Make##Class},
#include "controllers/drives.inc"
#undef FP_DRIVE
  };
  return kTable;
}

std::span<const PluginEntry<Estimator>> Estimators() {
  static constexpr PluginEntry<Estimator> kTable[] = {
#define FP_ESTIMATOR(Class, name, help) {name, help, &Make##Class},
#include "controllers/estimators.inc"
#undef FP_ESTIMATOR
  };
  return kTable;
}

std::span<const PluginEntry<Tracker>> Trackers() {
  static constexpr PluginEntry<Tracker> kTable[] = {
#define FP_TRACKER(Class, name, help) {name, help, &Make##Class},
#include "controllers/trackers.inc"
#undef FP_TRACKER
  };
  return kTable;
}

const PluginEntry<Drive>* DriveFor(const RobotSpec& robot, std::string& why) {
  const auto takes = [&](const PluginEntry<Drive>& entry) {
    try {
      entry.make()->Configure(robot);
      return true;
    } catch (const InputError& e) {
      why += std::string("; ") + e.what();
      return false;
    }
  };
  why = "no drive takes its wheels";
  const auto entry = std::ranges::find_if(Drives(), takes);
  return entry == Drives().end() ? nullptr : &*entry;
}

bool IsHolonomic(const RobotSpec& robot) {
  return MakePlugin(Drives(), robot.drive, "drive", {robot.model_file, 0})->holonomic();
}

void RequireLimits(const RobotSpec& robot, std::string_view tracker) {
  const auto require = [&](const std::string& key, double value) {
    if (!(value > 0))
      throw InputError({robot.model_file, 0}, key, FormatDouble(value),
                       "must be > 0 for the tracker " + std::string(tracker));
  };
  require("cruise_mps", robot.cruise_mps);
  require("max_speed_mps", robot.max_speed_mps);
  require("max_accel_mps2", robot.max_accel_mps2);
  require("max_yaw_rate_radps", robot.max_yaw_rate_radps);
  require("max_yaw_accel_radps2", robot.max_yaw_accel_radps2);
}

std::string_view DefaultTracker(std::string_view drive) {
  for (const auto& known : Drives())
    for (const auto& entry : Trackers())
      if (known.name == drive && entry.make()->Commands(*known.make())) return entry.name;
  throw InputError("no tracker commands a robot of drive " + std::string(drive));
}

}  // namespace floorproof
