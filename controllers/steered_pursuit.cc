// SPDX-License-Identifier: Apache-2.0
// Pure pursuit for robots that turn only while they drive on.
//
// The robot drives the arc from the middle of its axle to a point ahead on the path, v *
// lookahead_s away (Coulter 1992, "Implementation of the pure pursuit path tracking algorithm";
// curvature 2 y / d^2), at most as tight as its steering allows. To a point behind it, it turns
// with the wheel hard over. The speed is regulated as in regulated_pursuit, by the arc's curvature,
// by the gap to known obstacles, and by the passing speeds of the bends ahead; that the wheel needs
// time to turn is the drive's affair. Corners sharper than it can turn are passed wide. A stop that
// it cannot come to without a loop is missed. Assumes a plan without such corners (planners/lines/
// turn_curves.h); does not reverse.
#include <algorithm>
#include <cmath>
#include <limits>

#include "controllers/drive.h"
#include "controllers/drive_time.h"
#include "controllers/follower_params.h"
#include "controllers/path_progress.h"
#include "controllers/pursuit_twist.h"
#include "controllers/tracker.h"

namespace floorproof {
namespace {

constexpr double kBehind_rad = 1.7;  // farther aside an arc to the point ahead would be tighter

class SteeredPursuit final : public Tracker {
 public:
  void Visit(ParamVisitor& v) override {
    lookahead_.Visit(v);
    v("corner_cut_m", params_.corner_cut_m, Between(0.001, 0.5),
      "how far bends may be cut: slower is nearer");
    v("corner_tolerance_m", params_.corner_tolerance_m, Between(0.002, 0.5),
      "a stop or the last waypoint is reached within this along the way");
    params_.obstacles.Visit(v);
  }

  bool Commands(const Drive& drive) const override {
    return !drive.turns_on_the_spot() && !drive.holonomic();
  }

  void Start(const Path& path, const RobotSpec& robot, const ClearanceField* clearance) override {
    RequireLimits(robot, "steered_pursuit");
    gap_.Start(params_.obstacles, robot, clearance);
    motion_.Start(robot);
    tightest_1pm_ = 1 / std::max(robot.turn_radius_m, 1e-3);

    ReferenceLimits limits = params_.Limits(robot);
    limits.turn_radius_m = robot.turn_radius_m;
    bend_yaw_rate_radps_ = limits.yaw_rate_radps;
    progress_.Start(path, limits, params_.corner_tolerance_m);
    side_ = 0;
    constexpr double kNever = std::numeric_limits<double>::infinity();
    duration_s_ = DriveTime(progress_.reference(),
                            {limits, params_.corner_tolerance_m, kNever, kNever}, robot);
    duration_s_ += gap_.Delay(progress_.reference());
  }

  void Extend(const Path& path) override { progress_.Extend(path); }

  void Slow(double share) override {
    motion_.Slow(share);
    progress_.Slow(share);
  }

  double Duration() const override { return duration_s_; }

  MissedStops Missed() const override { return progress_.missed(); }

  Command Update(const Estimate& estimate, double t_s, double dt_s) override {
    const Pose2& X_WB = estimate.X_WB;
    progress_.Update(X_WB, t_s);
    if (progress_.phase() == PathProgress::Phase::kTurn) progress_.Drive();
    if (progress_.moving())
      Pursue(X_WB, dt_s);
    else
      motion_.Rest(dt_s);

    Command command;
    command.segment = progress_.Segment(X_WB.p());
    command.dwelling = progress_.phase() == PathProgress::Phase::kDwell;
    command.tasks = progress_.tasks();
    command.done = progress_.phase() == PathProgress::Phase::kDone;
    command.twist = motion_.twist();
    return command;
  }

 private:
  void Pursue(const Pose2& X_WB, double dt_s) {
    const auto [target_W, allowed_mps] =
        progress_.AimFrom(X_WB.p(), std::abs(motion_.twist().vx_mps), lookahead_);
    const double curvature = CurvatureTo(X_WB.Inverse() * target_W);
    const double speed_mps = gap_.Limit(allowed_mps, X_WB, target_W);
    motion_.Follow(std::min(speed_mps, bend_yaw_rate_radps_ / std::max(std::abs(curvature), 1e-9)),
                   curvature, dt_s);
  }

  // A robot that turns to a point behind it keeps its side.
  double CurvatureTo(const Vec2& target_B) {
    if (std::abs(std::atan2(target_B.y(), target_B.x())) > kBehind_rad) {
      if (side_ == 0) side_ = target_B.y() < 0 ? -1 : 1;
      return side_ * tightest_1pm_;
    }
    side_ = 0;
    return std::clamp(2 * target_B.y() / std::max(target_B.squaredNorm(), 1e-9), -tightest_1pm_,
                      tightest_1pm_);
  }

  FollowerParams params_{.corner_cut_m = 0.02,
                         .corner_tolerance_m = 0.01,
                         .heading_tolerance_deg = 0,
                         .recover_deg = 0};
  Lookahead lookahead_{0.65, 0.15, 0.4};

  ObstacleGap gap_;
  PathProgress progress_;
  PursuitTwist motion_;
  double bend_yaw_rate_radps_ = 0;
  double tightest_1pm_ = 0;
  int side_ = 0;  // of a turn to a point behind: 1 left, -1 right
  double duration_s_ = 0;
};

}  // namespace

FP_DEFINE_PLUGIN(Tracker, SteeredPursuit)

}  // namespace floorproof
