// SPDX-License-Identifier: Apache-2.0
// Rejoin: the rest of a plan, after the robot has met something that the plan did not know of.
#pragma once

#include "env/core/drawn_map.h"
#include "env/core/path.h"
#include "env/core/robot_spec.h"

namespace floorproof {

struct RejoinRequest {
  const HazardMap& known;  // what the plan was made with, and what was seen since (WithSeen)
  const std::vector<FloorMark>& marks;
  const RobotSpec& robot;
  const Shape2& clear;  // what the plan keeps clear
  const Path& path;
  std::size_t segment = 0;  // of the path, on which the robot was
  Pose2 X_WB;               // where the robot thinks it is
  // True: the robot takes the shortest way to where the path goes on beyond what it met. False: it
  // goes straight to the first place of that part to which a straight line leads, and takes the
  // shortest way only where there is no such place.
  bool around = true;
};

// A path from the robot to the end of the old one. It leaves out the parts where the clear shape
// would touch a mark, and what can no longer be reached. Waypoints that stay keep their yaw, shape,
// speed, dwell and task. The path holds at least one waypoint: the robot's own place, where nothing
// is left to drive.
// If the map says that the robot can be neither where it is nor near there, the map is not trusted:
// the rest is driven as it was planned. Time and memory grow with the map's area.
Path Rejoin(const RejoinRequest& request);

}  // namespace floorproof
