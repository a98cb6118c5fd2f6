// SPDX-License-Identifier: Apache-2.0
// Regulated pure pursuit with turns on the spot, for robots that turn about their centre.
//
// Between stops the robot follows the arc to a point ahead on the path, v * lookahead_s away
// (Coulter 1992, "Implementation of the pure pursuit path tracking algorithm"; curvature 2 y /
// d^2). The speed is regulated (Macenski, Singh, Martin & Gines 2023, "Regulated pure pursuit for
// robot path tracking") by the arc's curvature, by the gap to known obstacles, and by the passing
// speeds of the bends ahead (reference_path.h). The robot comes to rest at the end of each straight
// that ends in a corner, and turns there (path_progress.h). If it was pushed off, it turns to its
// leg and goes back. Assumes a drive that turns on the spot; does not plan around obstacles, does
// not reverse.
#include <algorithm>
#include <cmath>

#include "controllers/drive.h"
#include "controllers/drive_time.h"
#include "controllers/follower_params.h"
#include "controllers/path_progress.h"
#include "controllers/pursuit_twist.h"
#include "controllers/tracker.h"

namespace floorproof {
namespace {

constexpr double kAboutFaceRad = 2.8;  // near 180 deg a turn keeps its side

class RegulatedPursuit final : public Tracker {
 public:
  void Visit(ParamVisitor& v) override {
    const FollowerHelp help{
        "corners sharper than this are turned on the spot",
        "when the point pursued lies farther aside than this the robot stops and turns to it", 20};
    params_.Visit(v, help, [&] { lookahead_.Visit(v); });
  }

  // It would not keep the yaws that plans for holonomic robots state.
  bool Commands(const Drive& drive) const override {
    return drive.turns_on_the_spot() && !drive.holonomic();
  }

  void Start(const Path& path, const RobotSpec& robot, const ClearanceField* clearance) override {
    RequireLimits(robot, "regulated_pursuit");
    gap_.Start(params_.obstacles, robot, clearance);
    motion_.Start(robot);

    ReferenceLimits limits = params_.Limits(robot);
    limits.faces = true;
    bend_yaw_rate_radps_ = limits.yaw_rate_radps;
    progress_.Start(path, limits, params_.corner_tolerance_m);
    turn_side_ = 0;
    duration_s_ = DriveTime(progress_.reference(),
                            {limits, params_.corner_tolerance_m,
                             Radians(params_.heading_tolerance_deg), Radians(params_.recover_deg)},
                            robot);
    duration_s_ += gap_.Delay(progress_.reference());
  }

  void Extend(const Path& path) override { progress_.Extend(path); }

  void Slow(double share) override {
    motion_.Slow(share);
    progress_.Slow(share);
  }

  double Duration() const override { return duration_s_; }

  Command Update(const Estimate& estimate, double t_s, double dt_s) override {
    const Pose2& X_WB = estimate.X_WB;
    const std::size_t vertex = progress_.vertex();
    progress_.Update(X_WB, t_s);
    if (progress_.vertex() != vertex) turn_side_ = 0;
    if (progress_.phase() == Phase::kFace)
      Face(X_WB, t_s, dt_s);
    else if (progress_.moving())
      Pursue(X_WB, t_s, dt_s);
    else
      motion_.Rest(dt_s);

    Command command;
    command.segment = progress_.Segment(X_WB.p());
    command.dwelling = progress_.phase() == Phase::kDwell;
    command.tasks = progress_.tasks();
    command.turning = progress_.phase() == Phase::kTurn || progress_.phase() == Phase::kFace;
    command.done = progress_.phase() == Phase::kDone;
    command.twist = motion_.twist();
    return command;
  }

 private:
  using Phase = PathProgress::Phase;

  void Pursue(const Pose2& X_WB, double t_s, double dt_s) {
    const auto [target_W, speed_mps] =
        progress_.AimFrom(X_WB.p(), std::abs(motion_.twist().vx_mps), lookahead_);
    const Vec2 target_B = X_WB.Inverse() * target_W;
    const double aside_rad = std::atan2(target_B.y(), target_B.x());
    if (progress_.phase() == Phase::kDrive && std::abs(aside_rad) > Radians(params_.recover_deg)) {
      progress_.Turn(X_WB.p());
      turn_side_ = 0;
    }
    if (progress_.phase() == Phase::kTurn &&
        std::abs(aside_rad) <= Radians(params_.heading_tolerance_deg))
      progress_.Drive();
    if (progress_.phase() == Phase::kTurn)
      Turn(aside_rad, t_s, dt_s);
    else
      Follow(target_B, gap_.Limit(speed_mps, X_WB, target_W), dt_s);
  }

  // Turned far enough, it comes to rest in the dwell.
  void Face(const Pose2& X_WB, double t_s, double dt_s) {
    const double aside_rad = WrapAngle(*progress_.face_rad() - X_WB.yaw_rad);
    Turn(aside_rad, t_s, dt_s);
    if (std::abs(aside_rad) > Radians(params_.heading_tolerance_deg)) return;
    turn_side_ = 0;
    progress_.Faced(t_s);
  }

  void Turn(double aside_rad, double t_s, double dt_s) {
    if (turn_side_ == 0) motion_.BeginTurn();
    if (std::abs(aside_rad) < kAboutFaceRad || turn_side_ == 0) turn_side_ = aside_rad < 0 ? -1 : 1;
    motion_.TurnOnTheSpot(aside_rad, turn_side_, t_s, dt_s);
  }

  void Follow(const Vec2& target_B, double speed_mps, double dt_s) {
    const double curvature = 2 * target_B.y() / std::max(target_B.squaredNorm(), 1e-9);
    speed_mps = std::min(speed_mps, bend_yaw_rate_radps_ / std::max(std::abs(curvature), 1e-9));
    motion_.Follow(speed_mps, curvature, dt_s);
  }

  FollowerParams params_{.corner_cut_m = 0.02,
                         .corner_tolerance_m = 0.01,
                         .heading_tolerance_deg = 1.5,
                         .recover_deg = 70};
  // A smaller value overshoots in bends when wheels are late by 0.25 s; a larger one cuts 45 deg
  // bends by over 0.03 m.
  Lookahead lookahead_{0.65, 0.12, 0.4};

  ObstacleGap gap_;
  PathProgress progress_;
  PursuitTwist motion_;
  double bend_yaw_rate_radps_ = 0;
  int turn_side_ = 0;
  double duration_s_ = 0;
};

}  // namespace

FP_DEFINE_PLUGIN(Tracker, RegulatedPursuit)

}  // namespace floorproof
