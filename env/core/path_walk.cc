// SPDX-License-Identifier: Apache-2.0
#include "env/core/path_walk.h"

#include <algorithm>
#include <cmath>

#include "env/core/blocks.h"

namespace floorproof {
namespace {

constexpr double kSamePoint_m = 1e-6;

}  // namespace

PathWalk::PathWalk(const Path& path, const RobotSpec& robot, bool holds_yaw, const Pose2& from,
                   std::size_t segment)
    : path_(path), robot_(robot), holds_yaw_(holds_yaw), to_(segment + 1) {
  pose_.X_WB = from;
  pose_.shape = robot.shape;
  if (segment < path.size()) {
    const Vec2& begin = path[segment].p_W;
    const Vec2 at = to_ < path.size()
                        ? Vec2(begin + NearestFraction(begin, path[to_].p_W, from.p()) *
                                           (path[to_].p_W - begin))
                        : begin;
    pose_.X_WB.x_m = at.x(), pose_.X_WB.y_m = at.y();
  }
  Aim();
}

// What the way to the next waypoint asks for.
void PathWalk::Aim() {
  yaw_to_rad_ = pose_.X_WB.yaw_rad;
  if (to_ >= path_.size()) return;
  const Waypoint& to = path_[to_];
  const Vec2 way = to.p_W - pose_.X_WB.p();
  if (holds_yaw_ && to.yaw_rad)
    yaw_to_rad_ = *to.yaw_rad;
  else if (way.norm() >= kSamePoint_m)
    yaw_to_rad_ = std::atan2(way.y(), way.x());
  if (!to.shape.empty())
    if (const int shape = FindShape(robot_, to.shape); shape >= 0) pose_.shape = shape;
  pose_.speed_mps = to.speed_mps > 0 ? to.speed_mps : robot_.cruise_mps;
}

bool PathWalk::Next() {
  if (to_ >= path_.size()) return false;
  const double turn_rad = WrapAngle(yaw_to_rad_ - pose_.X_WB.yaw_rad);
  if (std::abs(turn_rad) > 1e-9) {
    pose_.travel_W = Vec2::Zero();
    pose_.X_WB.yaw_rad = std::abs(turn_rad) <= kTurn_rad
                             ? yaw_to_rad_
                             : WrapAngle(pose_.X_WB.yaw_rad + std::copysign(kTurn_rad, turn_rad));
    return true;
  }
  const Vec2 way = path_[to_].p_W - pose_.X_WB.p();
  const double left_m = way.norm();
  if (left_m < kSamePoint_m) {
    ++to_;
    Aim();
    return Next();
  }
  pose_.travel_W = way / left_m;
  const double step_m = std::min(left_m, kStep_m);
  const Vec2 p_W =
      left_m <= kStep_m ? path_[to_].p_W : Vec2(pose_.X_WB.p() + step_m * pose_.travel_W);
  pose_.X_WB.x_m = p_W.x(), pose_.X_WB.y_m = p_W.y();
  pose_.along_m += step_m;
  return true;
}

}  // namespace floorproof
