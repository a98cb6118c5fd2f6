// SPDX-License-Identifier: Apache-2.0
// The floor that a robot covers along a plan, piece by piece.
#pragma once

#include <functional>
#include <vector>

#include "env/core/path.h"
#include "env/scene/robot_model.h"

namespace floorproof {

// A straight piece of the way, or a pose of a turn or a folding where the robot stands.
struct SweptPiece {
  const std::vector<Polygon>& parts_W;  // convex, together all that the robot covers on it
  const std::vector<Polygon>& begin_W;  // the same parts where the piece begins
  Pose2 X_WB;                           // at its begin
  double along_m = 0;                   // way of the plan to there
  double length_m = 0;                  // 0: it stands
  Vec2 direction_W = Vec2::Zero();      // unit; 0 where it stands
  double width_m = 0;                   // of the robot across the way; 0 where it stands
};

// Straight pieces are at most a quarter of a metre long. Turns are looked at every 3 degrees,
// which is by 0.1 mm less than they sweep, and foldings every 5.
void SweepPlan(const RobotModel& robot, const Pose2& start, const Path& path,
               const std::function<void(const SweptPiece&)>& visit);

}  // namespace floorproof
