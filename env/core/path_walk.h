// SPDX-License-Identifier: Apache-2.0
// A path as a robot drives it exactly, in small steps: straight ways, and turns on the spot between
// them. Nothing of its tracker is in it: no corner is cut, and its speed is the plan's.
#pragma once

#include <cstddef>

#include "env/core/path.h"
#include "env/core/robot_spec.h"

namespace floorproof {

struct PathPose {
  Pose2 X_WB;
  Vec2 travel_W = Vec2::Zero();  // unit; zero while it turns on the spot
  double along_m = 0;            // way from where the walk began
  double speed_mps = 0;          // the plan's on this way
  int shape = 0;                 // index into RobotSpec::shapes; 0 of a rigid robot
};

class PathWalk {
 public:
  static constexpr double kStep_m = 0.02, kTurn_rad = 0.1;

  // From the place of the way from waypoint `segment` to the next that is nearest to `from`, whose
  // yaw the robot has there. `holds_yaw`: it takes the plan's yaws (holonomic robots); else it
  // looks along its way. All outlive it.
  PathWalk(const Path& path, const RobotSpec& robot, bool holds_yaw, const Pose2& from,
           std::size_t segment = 0);

  const PathPose& pose() const { return pose_; }
  // A step on; false at the path's end.
  bool Next();

 private:
  void Aim();

  const Path& path_;
  const RobotSpec& robot_;
  bool holds_yaw_;
  std::size_t to_;  // the waypoint that it goes to
  PathPose pose_;
  double yaw_to_rad_ = 0;
};

}  // namespace floorproof
