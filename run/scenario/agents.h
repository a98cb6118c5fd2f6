// SPDX-License-Identifier: Apache-2.0
// Who acts in one episode: who plans, drives, senses, watches and judges.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "controllers/estimator.h"
#include "controllers/mapper.h"
#include "controllers/recovery.h"
#include "controllers/supervision/safety_plan.h"
#include "controllers/tracker.h"
#include "env/failures/detector.h"
#include "env/sensors/sensor.h"
#include "planners/online/online_planner.h"
#include "planners/planner.h"

namespace floorproof {

struct Agents {
  std::unique_ptr<Planner> planner;       // none: somebody else's plan
  std::unique_ptr<OnlinePlanner> online;  // on the way, as the floor becomes known
  std::unique_ptr<Tracker> tracker;
  std::unique_ptr<Estimator> estimator;
  std::vector<NamedSensor> sensors;        // those written, and those that a part of it needs
  std::optional<Mapper> mapper;            // none: no map is drawn
  std::optional<RecoveryParams> recovery;  // none: the plan is driven blindly
  std::optional<SafetyPlan> safety;        // none: nobody watches it
  std::vector<NamedDetector> detectors;
};

}  // namespace floorproof
