// SPDX-License-Identifier: Apache-2.0
// A planner's plan, made fit for a robot that cannot turn on the spot (turn_curves.h).
#pragma once

#include "planners/planner.h"

namespace floorproof {

// Its curves are so much wider than the robot's tightest arc: what is left corrects errors.
inline constexpr double kTurnReserve = 1.2;

// The same of a part of a plan, from where the robot is. `clear`: what the plan keeps clear. Empty:
// no curve leads away from there.
Path FitTurns(const Path& path, const HazardMap& map, const RobotSpec& robot, const Shape2& clear,
              const Pose2& X_WB);

// Does nothing to a plan that did not succeed, nor where the robot has no turn_radius_m. The
// message says what of the plan is left out and what coverage that costs; the figures are
// turn_radius_m, lanes_left_out and turns_cost_coverage. Where no curve leads away from the start
// the plan fails.
void FitTurns(const PlanRequest& request, PlanResult& plan);

}  // namespace floorproof
