// SPDX-License-Identifier: Apache-2.0
// Why a robot can do nothing from where it starts, in words.
#pragma once

#include <string>

#include "env/core/coverage.h"
#include "planners/planner.h"

namespace floorproof {

inline constexpr const char* kNotConvex =
    "the robot's footprint is not convex; it can be driven along a plan of your own, or planned "
    "for "
    "in a convex shape";
// Whether the clear shape that the area was computed with fits at the start.
bool StartFits(const SweepArea& area);
// Of an area of which nothing can be swept: the start with its place and the map's cell, and what
// is wrong there.
std::string WhyNothing(const PlanRequest& request, const SweepArea& area, const Shape2& clear);

}  // namespace floorproof
