// SPDX-License-Identifier: Apache-2.0
// Drives a plan to its end. What is met on the way is gone around: the rest of the plan is joined
// anew, from where the robot thinks it is (planners/lines/rejoin.h).
#pragma once

#include "controllers/navigator.h"
#include "controllers/recovery.h"
#include "env/core/hazard_map.h"
#include "env/core/robot_spec.h"
#include "planners/planner.h"

namespace floorproof {

class PlanNavigator final : public Navigator {
 public:
  // All outlive it. `plan` was made on `known`; `recovery` may be nullptr: nothing is gone around.
  PlanNavigator(const PlanResult& plan, const HazardMap& known, const RobotSpec& robot,
                const RecoveryParams* recovery);

  const Path& path() const override { return path_; }
  PathChange Update(const NavigatorInput& input) override;
  Leads leads() const override { return Leads::kToEnd; }
  const Path& plan() const override { return plan_.path; }
  void GoOnFrom(std::size_t waypoint) override;

 private:
  const PlanResult& plan_;
  const HazardMap& known_;
  const RobotSpec& robot_;
  bool around_;
  Path path_;
};

}  // namespace floorproof
