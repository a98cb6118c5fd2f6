// SPDX-License-Identifier: Apache-2.0
// Leads a robot along the lines that its mission asks for, one after the other.
#pragma once

#include "controllers/navigator.h"
#include "env/core/robot_spec.h"
#include "planners/planner.h"

namespace floorproof {

// How long a robot takes for these places, its turns at each included: an estimate, for time
// limits.
double GoToDuration(const Path& places, const RobotSpec& robot);

class GoToNavigator final : public Navigator {
 public:
  // It outlives it: the mission's places, from the start on.
  explicit GoToNavigator(const PlanResult& plan);

  const Path& path() const override { return path_; }
  PathChange Update(const NavigatorInput& input) override;
  Leads leads() const override { return Leads::kToEnd; }
  const Path& plan() const override { return plan_.path; }
  // At the end of its line, or on the way there: the line is asked for until it is driven.
  void GoOnFrom(std::size_t) override {}

 private:
  const PlanResult& plan_;
  Path path_;
  int line_ = 0;  // the number of that which path_ is
};

}  // namespace floorproof
