// SPDX-License-Identifier: Apache-2.0
// The rest of a plan, after something was met on it that the plan did not know.
#pragma once

#include "env/core/known_map.h"
#include "env/core/path.h"
#include "env/core/robot_spec.h"

namespace floorproof {

struct RejoinRequest {
  const HazardMap& known;  // as it was planned with, and what was seen since (WithSeen)
  const std::vector<FloorMark>& marks;
  const RobotSpec& robot;
  const Shape2& clear;  // what the plan keeps clear
  const Path& path;
  std::size_t segment = 0;  // that was driven
  Pose2 X_WB;               // where the robot thinks it is
  // To where the path goes on beyond what was met, by the shortest way; else straight to the first
  // place of that part that can be gone to so (around where there is none).
  bool around = true;
};

// From the robot to the end of the path, without what the clear shape cannot drive beside the
// marks. Waypoints keep their yaw, shape, speed, dwell and task. At least one waypoint; only the robot's
// place where nothing is left. Where the map says that the robot cannot be where it is, or came
// from, the rest is driven as it was planned. Takes time and memory as the map's area.
Path Rejoin(const RejoinRequest& request);

}  // namespace floorproof
