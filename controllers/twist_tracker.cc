// SPDX-License-Identifier: Apache-2.0
#include "controllers/twist_tracker.h"

#include <algorithm>
#include <cmath>

#include "controllers/drive_time.h"
#include "controllers/follower_params.h"

namespace floorproof {
namespace {

// As the followers that are built in have them.
constexpr FollowerParams kParams{.corner_cut_m = 0.02,
                                 .corner_tolerance_m = 0.02,
                                 .heading_tolerance_deg = 2,
                                 .recover_deg = 60};
constexpr Lookahead kLookahead;

}  // namespace

const Waypoint* FirstFold(const Path& path, const RobotSpec& robot) {
  if (robot.hinges.empty()) return nullptr;
  const auto fold = std::ranges::find_if_not(path, &std::string::empty, &Waypoint::shape);
  return fold == path.end() ? nullptr : &*fold;
}

void TwistTracker::Start(const Path& path, const RobotSpec& robot, const ClearanceField*) {
  RequireLimits(robot, "plug-in");
  if (const Waypoint* fold = FirstFold(path, robot))
    throw InputError({}, "shape", fold->shape, "a plug-in tracker cannot change the robot's shape");
  robot_ = robot;
  ReferenceLimits limits = kParams.Limits(robot);
  limits.turn_radius_m = robot.turn_radius_m;
  progress_.Start(path, limits, kParams.corner_tolerance_m);
  twist_ = {};
  share_ = 1;
  duration_s_ = DriveTime(progress_.reference(),
                          {limits, kParams.corner_tolerance_m,
                           Radians(kParams.heading_tolerance_deg), Radians(kParams.recover_deg)},
                          robot);
  OnPath(path, robot);
}

void TwistTracker::Extend(const Path& path) {
  progress_.Extend(path);
  OnPath(path, robot_);
}

Command TwistTracker::Update(const Estimate& estimate, double t_s, double dt_s) {
  const Vec2 p_W = estimate.X_WB.p();
  progress_.Update(estimate.X_WB, t_s);
  // Whether it turns first is the affair of who commands it.
  if (progress_.phase() == PathProgress::Phase::kTurn) progress_.Drive();

  Command command;
  command.segment = progress_.Segment(p_W);
  command.dwelling = progress_.phase() == PathProgress::Phase::kDwell;
  command.tasks = progress_.tasks();
  command.done = !free_ && progress_.phase() == PathProgress::Phase::kDone;
  BodyTwist wanted;
  if (progress_.moving()) {
    const auto [target_W, speed_mps] =
        progress_.AimFrom(p_W, std::hypot(twist_.vx_mps, twist_.vy_mps), kLookahead);
    wanted = Twist({estimate, t_s, dt_s, command.segment, target_W, speed_mps});
  } else if (free_) {
    wanted = Twist({estimate, t_s, dt_s, 0, p_W, robot_.cruise_mps});
  }
  MoveTowards(wanted, dt_s);
  command.twist = twist_;
  // Turning without driving is progress, as it is of every tracker that turns on the spot.
  command.turning = (free_ || progress_.moving()) && wanted.vx_mps == 0 && wanted.vy_mps == 0;
  return command;
}

void TwistTracker::MoveTowards(const BodyTwist& wanted, double dt_s) {
  const Vec2 last(twist_.vx_mps, twist_.vy_mps);
  Vec2 v_B(wanted.vx_mps, wanted.vy_mps);
  v_B *= share_ * std::min(1.0, robot_.max_speed_mps / std::max(v_B.norm(), 1e-12));
  Vec2 change = v_B - last;
  change *= std::min(1.0, robot_.max_accel_mps2 * dt_s / std::max(change.norm(), 1e-12));
  twist_.vx_mps = last.x() + change.x();
  twist_.vy_mps = last.y() + change.y();
  const double most = robot_.max_yaw_rate_radps, dw = robot_.max_yaw_accel_radps2 * dt_s;
  twist_.wz_radps = std::clamp(share_ * std::clamp(wanted.wz_radps, -most, most),
                               twist_.wz_radps - dw, twist_.wz_radps + dw);
}

}  // namespace floorproof
