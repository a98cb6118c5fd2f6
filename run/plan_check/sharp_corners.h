// SPDX-License-Identifier: Apache-2.0
// Corners of a plan that a robot which cannot turn on the spot passes beside.
#pragma once

#include "env/core/path.h"
#include "env/core/robot_spec.h"

namespace floorproof {

// Waypoints that the robot's tightest arc along both legs passes by more than it may stray, 20 mm.
// None of a robot that turns on the spot.
int CountSharpCorners(const Path& path, const RobotSpec& robot);

}  // namespace floorproof
