// SPDX-License-Identifier: Apache-2.0
// What lies under a plan though the robot need not keep off it, or is not told of it.
#pragma once

#include <cstddef>
#include <vector>

#include "planners/planner.h"

namespace floorproof {

struct World;

// A hazard of the site that the robot's outline comes over.
struct DrivenOver {
  std::size_t hazard = 0;  // index into TrueFloor's hazards (run/scenario/floors.h)
  int times = 0;           // that the plan comes to it; again within 0.3 m of its way is once
  double over_m = 0;       // way along the plan above it, to a quarter of a metre
};

// Of the true site: what is known and can be driven over, and whatever is not known. Those that are
// not known first, and of each kind the one with the longest way. The robot is moved as
// CheckClearance (run/plan_check/plan_clearance.h) moves it, which says what it must keep off.
std::vector<DrivenOver> FindDrivenOver(const World& world, const PlanResult& plan);

}  // namespace floorproof
