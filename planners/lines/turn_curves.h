// SPDX-License-Identifier: Apache-2.0
// Plans for robots that cannot turn on the spot: legs joined by curves that they can drive.
//
// A plan's straight legs are kept, in their order and direction, shortened where the turn at their
// end needs the room; what joins them is the shortest Dubins curve that stays clear (dubins.h).
// Legs that no curve joins to the rest are left out, short ones also where the way is shorter
// without (leg_choice.h). The robot drives forward only. Assumed: where a leg leads is clear; the
// clear shape is a circle.
#pragma once

#include "env/core/coverage.h"
#include "env/core/path.h"

namespace floorproof {

struct TurnRequest {
  const ClearanceField& clearance;
  double clear_radius_m = 0;  // of the circle around the robot's origin
  double margin_m = 0;        // kept beyond it in turns, where the plan keeps as much there
  double turn_radius_m = 0;   // least of the curves
  double lane_m = 0;          // a leg that is no longer only joins others: it is not counted
  Pose2 start;                // X_WB
};

struct TurnedPath {
  Path path;                    // empty: no curve leads from the start to any leg
  int lanes = 0, left_out = 0;  // legs of more than TurnRequest::lane_m
  double left_out_m = 0;        // length of those that are left out
  int stops_left_out = 0;       // ends of legs with a dwell
};

// Takes time as the number of legs. Of what lies before each, few legs are looked at again.
TurnedPath WithTurns(const Path& path, const TurnRequest& request);

}  // namespace floorproof
