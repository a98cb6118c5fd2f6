// SPDX-License-Identifier: Apache-2.0
// Regulated pure pursuit with turns on the spot, for robots that turn about their centre.
//
// Between stops the robot follows the arc to a point ahead on the path, v * lookahead_s away
// (Coulter 1992, "Implementation of the pure pursuit path tracking algorithm"; curvature 2 y /
// d^2). Speed is regulated (Macenski, Singh, Martin & Gines 2023, "Regulated pure pursuit for robot
// path tracking") by the arc's curvature, by the gap to known obstacles, and by the passing speeds
// of the bends ahead (reference_path.h); it comes to rest at the end of each straight that ends in
// a corner, and turns there (path_progress.h). Pushed off, the robot turns to its leg and goes
// back. Assumes a drive that turns on the spot; does not plan around obstacles, does not reverse.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "controllers/obstacle_gap.h"
#include "controllers/path_progress.h"
#include "controllers/tracker.h"

namespace floorproof {
namespace {

constexpr double kAboutFaceRad = 2.8;  // near 180 deg a turn keeps its side
constexpr double kDecelShare = 0.8;    // of max_accel: what is left corrects
constexpr double kYawRateShare = 0.8;  // of max_yaw_rate: what is left corrects
constexpr double kLagS = 0.15;         // wheels reach their speed some 0.1 s late

class RegulatedPursuit final : public Tracker {
 public:
  void Visit(ParamVisitor& v) override {
    v("corner_deg", corner_deg_, Between(5, 90),
      "corners sharper than this are turned on the spot");
    v("lookahead_s", lookahead_.time_s, Between(0.3, 5), "time ahead of the point that is pursued");
    v("lookahead_min_m", lookahead_.min_m, Between(0.02, 2), "least way to the point pursued");
    v("lookahead_max_m", lookahead_.max_m, Between(0.02, 5), "largest way to the point pursued");
    v("corner_cut_m", corner_cut_m_, Between(0.001, 0.5),
      "how far bends may be cut that are driven through: slower is nearer");
    v("corner_tolerance_m", corner_tolerance_m_, Between(0.002, 0.5),
      "a corner or the last waypoint is reached within this along the way");
    v("heading_tolerance_deg", heading_tolerance_deg_, Between(0.2, 20),
      "a turn on the spot ends within this");
    v("recover_deg", recover_deg_, Between(20, 150),
      "when the point pursued lies farther aside than this the robot stops and turns to it");
    gap_.Visit(v);
  }

  std::vector<std::string> Drives() const override { return {"differential"}; }

  void Start(const Path& path, const RobotSpec& robot, const ClearanceField* clearance) override {
    RequireLimits(robot, "regulated_pursuit");
    gap_.Start(robot, clearance);
    accel_mps2_ = robot.max_accel_mps2;
    yaw_rate_radps_ = robot.max_yaw_rate_radps;
    yaw_accel_radps2_ = robot.max_yaw_accel_radps2;

    ReferenceLimits limits;
    limits.corner_rad = Radians(corner_deg_);
    limits.cut_m = corner_cut_m_;
    limits.yaw_rate_radps = bend_yaw_rate_radps_ = kYawRateShare * yaw_rate_radps_;
    limits.yaw_accel_radps2 = yaw_accel_radps2_;
    limits.decel_mps2 = kDecelShare * accel_mps2_;
    limits.lag_s = kLagS;
    limits.cruise_mps = robot.cruise_mps;
    limits.max_speed_mps = robot.max_speed_mps;
    progress_.Start(path, limits, corner_tolerance_m_);
    twist_ = {};
    turn_side_ = 0;
  }

  Command Update(const Estimate& estimate, double t_s, double dt_s) override {
    const Pose2& X_WB = estimate.X_WB;
    const std::size_t vertex = progress_.vertex();
    progress_.Update(X_WB.p(), t_s);
    if (progress_.vertex() != vertex) turn_side_ = 0;
    if (progress_.moving())
      Pursue(X_WB, dt_s);
    else
      Slew(0, 0, dt_s);

    Command command;
    command.segment = progress_.Segment(X_WB.p());
    command.dwelling = progress_.phase() == Phase::kDwell;
    command.done = progress_.phase() == Phase::kDone;
    command.twist = twist_;
    return command;
  }

 private:
  using Phase = PathProgress::Phase;

  static double Radians(double deg) { return deg * kPi / 180; }

  void Pursue(const Pose2& X_WB, double dt_s) {
    const auto [target_W, speed_mps] =
        progress_.AimFrom(X_WB.p(), std::abs(twist_.vx_mps), lookahead_);
    const Vec2 target_B = X_WB.Inverse() * target_W;
    const double aside_rad = std::atan2(target_B.y(), target_B.x());
    if (progress_.phase() == Phase::kDrive && std::abs(aside_rad) > Radians(recover_deg_)) {
      progress_.Turn();
      turn_side_ = 0;
    }
    if (progress_.phase() == Phase::kTurn && std::abs(aside_rad) <= Radians(heading_tolerance_deg_))
      progress_.Drive();
    if (progress_.phase() == Phase::kTurn)
      Turn(aside_rad, dt_s);
    else
      Follow(target_B, gap_.Limit(speed_mps, X_WB, target_W), dt_s);
  }

  void Turn(double aside_rad, double dt_s) {
    if (std::abs(aside_rad) < kAboutFaceRad || turn_side_ == 0) turn_side_ = aside_rad < 0 ? -1 : 1;
    const double rate = StoppingSpeed(std::abs(aside_rad), kDecelShare * yaw_accel_radps2_, kLagS);
    Slew(0, turn_side_ * std::min(yaw_rate_radps_, rate), dt_s);
  }

  void Follow(const Vec2& target_B, double speed_mps, double dt_s) {
    const double curvature = 2 * target_B.y() / std::max(target_B.squaredNorm(), 1e-9);
    speed_mps = std::min(speed_mps, bend_yaw_rate_radps_ / std::max(std::abs(curvature), 1e-9));
    Slew(speed_mps, std::nullopt, dt_s, curvature);
  }

  // Moves the command towards what is wanted as fast as the robot's accelerations allow.
  void Slew(double vx_mps, std::optional<double> wz_radps, double dt_s, double curvature = 0) {
    const double dv = accel_mps2_ * dt_s, dw = yaw_accel_radps2_ * dt_s;
    twist_.vx_mps = std::clamp(vx_mps, twist_.vx_mps - dv, twist_.vx_mps + dv);
    const double wanted =
        wz_radps ? *wz_radps
                 : std::clamp(curvature * twist_.vx_mps, -yaw_rate_radps_, yaw_rate_radps_);
    twist_.wz_radps = std::clamp(wanted, twist_.wz_radps - dw, twist_.wz_radps + dw);
  }

  double corner_deg_ = 50;  // 45 deg bends of grid contours are still driven through
  // Less overshoots in bends when wheels are late by 0.25 s, more cuts 45 deg bends by over 0.03 m.
  Lookahead lookahead_{0.65, 0.12, 0.4};
  double corner_cut_m_ = 0.02, corner_tolerance_m_ = 0.01;
  double heading_tolerance_deg_ = 1.5, recover_deg_ = 70;
  ObstacleGap gap_;

  PathProgress progress_;
  double accel_mps2_ = 0, yaw_rate_radps_ = 0, yaw_accel_radps2_ = 0, bend_yaw_rate_radps_ = 0;
  BodyTwist twist_;  // last commanded
  int turn_side_ = 0;
};

}  // namespace

FP_DEFINE_PLUGIN(Tracker, RegulatedPursuit)

}  // namespace floorproof
