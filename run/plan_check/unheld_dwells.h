// SPDX-License-Identifier: Apache-2.0
// Stops of a plan on slopes that nothing holds the robot on.
#pragma once

#include <optional>

#include "planners/planner.h"

namespace floorproof {

struct World;

struct UnheldDwell {
  Vec2 p_W = Vec2::Zero();
  double slope_rad = 0;
  double holds_n = 0;  // what its motors hold it with, on the slope
  double pulls_n = 0;  // of its weight, down the slope
};

// The steepest of the plan's dwells on a slope of the true floor where the robot rolls away: its
// wheels turn freely, or its motors, which hold it, are too weak. A brake holds on every slope. Not
// looked at: whether the tyres slip.
std::optional<UnheldDwell> FindUnheldDwell(const World& world, const PlanResult& plan);

}  // namespace floorproof
