// SPDX-License-Identifier: Apache-2.0
// What of a robot can run into things, seen from above.
#pragma once

#include <vector>

#include "env/scene/robot_model.h"

namespace floorproof {

// Convex polygons, body frame B, m, which together hold everything that collides, as the robot
// stands at the start: the footprint of its shape, cut into convex parts; of a robot that keeps a
// circle clear the outlines of its geoms, which may fill less than the circle. Round geoms are
// polygons of 72 corners, too small by 0.1 % of their radius.
std::vector<Polygon> OutlineOf(const RobotModel& robot);

}  // namespace floorproof
