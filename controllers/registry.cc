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

std::string_view DefaultTracker(std::string_view drive) {
  for (const auto& entry : Trackers()) {
    const auto drives = entry.make()->Drives();
    if (std::ranges::find(drives, drive) != drives.end()) return entry.name;
  }
  throw InputError("no tracker commands a robot of drive " + std::string(drive));
}

}  // namespace floorproof
