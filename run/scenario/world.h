// SPDX-License-Identifier: Apache-2.0
// The world of one episode: site, robot, physics, start and goal, scheduled faults, dirt.
#pragma once

#include <optional>
#include <vector>

#include "env/faults/schedule.h"
#include "env/map/site.h"
#include "env/scene/robot_model.h"
#include "env/scene/scene.h"
#include "run/scenario/floor_dirt.h"

namespace floorproof {

struct World {
  Site site;
  RobotModel robot;
  PhysicsParams physics;
  Pose2 start;
  std::optional<Vec2> goal;
  std::vector<ScheduledFault> faults;  // what breaks on the robot
  std::optional<FloorDirt> dirt;       // none: not asked for
};

}  // namespace floorproof
