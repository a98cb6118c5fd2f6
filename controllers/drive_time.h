// SPDX-License-Identifier: Apache-2.0
// How long a robot takes for a reference path, by the speeds and accelerations that its follower
// keeps to: an estimate made before the drive, for time limits.
#pragma once

#include "controllers/reference_path.h"
#include "env/core/robot_spec.h"

namespace floorproof {

struct DriveTimeLimits {
  ReferenceLimits reference;
  double tolerance_m = 0;    // a stop is reached within this
  double tolerance_rad = 0;  // a turn on the spot ends within this
  double turn_above_rad =
      0;  // where the heading changes by more than this, the robot stops to turn
};

// Seconds from the first vertex, the robot heading along its leg, to the last: ways, stops, turns
// on the spot and dwells. Not counted: folding, slowing down beside obstacles (ObstacleGap::Delay),
// and whatever goes wrong.
double DriveTime(const ReferencePath& path, const DriveTimeLimits& limits, const RobotSpec& robot);

}  // namespace floorproof
