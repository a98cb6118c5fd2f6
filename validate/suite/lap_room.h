// SPDX-License-Identifier: Apache-2.0
// A room with furniture that a lap leads around: where methods of localisation drive. No two of its
// corners look alike to a lidar.
#pragma once

#include "validate/suite/bench_floor.h"

namespace floorproof {

struct LapRoom {
  BenchFloor floor;
  Pose2 start;
  Path lap;
};

LapRoom MakeLapRoom(const RobotSpec& robot, double speed_mps);

// The estimator of a robot that finds its way by what it carries: its keys, with the first guess so
// far off. By lidar on the site's map where it has one, else by its wheels alone.
std::string EstimatorKeys(const RobotModel& robot, const Vec2& error_W, double error_rad);

}  // namespace floorproof
