// SPDX-License-Identifier: Apache-2.0
// Regulated pure pursuit with turns on the spot, for robots that turn about their centre.
//
// Between stops the robot follows the arc to a point ahead on the path, v * lookahead_s away
// (Coulter 1992, "Implementation of the pure pursuit path tracking algorithm"; curvature 2 y /
// d^2). Speed is regulated (Macenski, Singh, Martin & Gines 2023, "Regulated pure pursuit for robot
// path tracking") by the arc's curvature, by the gap to known obstacles, and by the passing speeds
// of the bends ahead (reference_path.h); it comes to rest at the end of each straight that ends in
// a corner, and turns there. Progress is monotone: a leg is left once, at its end, never for a
// nearer one, so that neighbouring rows cannot be mixed up. Pushed off, the robot turns to its leg
// and goes back. Past the end of a leg but beside it, it goes to the corner itself. Assumes a drive
// that turns on the spot; does not plan around obstacles, does not reverse.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "controllers/reference_path.h"
#include "controllers/tracker.h"

namespace floorproof {
namespace {

constexpr double kTimeSlackS = 1e-9;     // sums of control periods are not exact
constexpr double kBendGateM = 0.3;       // a leg is left only this near its end
constexpr double kBesideCornerM = 0.04;  // farther beside a corner than this it is not reached yet
constexpr double kAboutFaceRad = 2.8;    // near 180 deg a turn keeps its side
constexpr double kDecelShare = 0.8;      // of max_accel: what is left corrects
constexpr double kYawRateShare = 0.8;    // of max_yaw_rate: what is left corrects
constexpr double kLagS = 0.15;           // wheels reach their speed some 0.1 s late

class RegulatedPursuit final : public Tracker {
 public:
  void Visit(ParamVisitor& v) override {
    v("corner_deg", corner_deg_, Between(5, 90),
      "corners sharper than this are turned on the spot");
    v("lookahead_s", lookahead_s_, Between(0.3, 5), "time ahead of the point that is pursued");
    v("lookahead_min_m", lookahead_min_m_, Between(0.02, 2), "least way to the point pursued");
    v("lookahead_max_m", lookahead_max_m_, Between(0.02, 5), "largest way to the point pursued");
    v("corner_cut_m", corner_cut_m_, Between(0.001, 0.5),
      "how far bends may be cut that are driven through: slower is nearer");
    v("corner_tolerance_m", corner_tolerance_m_, Between(0.002, 0.5),
      "a corner or the last waypoint is reached within this along the way");
    v("heading_tolerance_deg", heading_tolerance_deg_, Between(0.2, 20),
      "a turn on the spot ends within this");
    v("recover_deg", recover_deg_, Between(20, 150),
      "when the point pursued lies farther aside than this the robot stops and turns to it");
    v("obstacle_gap_m", obstacle_gap_m_, NonNegative(),
      "gap between clear shape and known obstacles below which it slows down");
    v("obstacle_speed_share", obstacle_share_, Between(0.1, 1), "share of the speed at no gap");
  }

  std::vector<std::string> Drives() const override { return {"differential"}; }

  void Start(const Path& path, const RobotSpec& robot, const ClearanceField* clearance) override {
    Require(robot, "cruise_mps", robot.cruise_mps);
    Require(robot, "max_speed_mps", robot.max_speed_mps);
    Require(robot, "max_accel_mps2", robot.max_accel_mps2);
    Require(robot, "max_yaw_rate_radps", robot.max_yaw_rate_radps);
    Require(robot, "max_yaw_accel_radps2", robot.max_yaw_accel_radps2);
    clearance_ = clearance;
    clear_radius_m_ =
        robot.inscribed_radius_m > 0 ? robot.inscribed_radius_m : robot.clear.radius_m;
    accel_mps2_ = robot.max_accel_mps2;
    yaw_rate_radps_ = robot.max_yaw_rate_radps;
    yaw_accel_radps2_ = robot.max_yaw_accel_radps2;

    limits_.corner_rad = Radians(corner_deg_);
    limits_.cut_m = corner_cut_m_;
    limits_.yaw_rate_radps = kYawRateShare * yaw_rate_radps_;
    limits_.yaw_accel_radps2 = yaw_accel_radps2_;
    limits_.decel_mps2 = kDecelShare * accel_mps2_;
    limits_.lag_s = kLagS;
    limits_.cruise_mps = robot.cruise_mps;
    limits_.max_speed_mps = robot.max_speed_mps;
    reference_ = MakeReference(path, limits_);

    // The way to the first waypoint is a homing to it; mostly the robot stands there already.
    phase_ = reference_.vertices.empty() ? Phase::kDone : Phase::kDrive;
    homing_ = true;
    vertex_ = goal_ = ahead_ = waypoint_ = 0;
    twist_ = {};
    turn_side_ = 0;
    dwell_until_s_ = 0;
  }

  Command Update(const Estimate& estimate, double t_s, double dt_s) override {
    const Pose2& X_WB = estimate.X_WB;
    if (phase_ == Phase::kDwell && t_s >= dwell_until_s_ - kTimeSlackS) Depart();
    if (phase_ == Phase::kTurn || phase_ == Phase::kDrive) Advance(X_WB.p(), t_s);

    if (phase_ == Phase::kTurn || phase_ == Phase::kDrive)
      Pursue(X_WB, dt_s);
    else
      Slew(0, 0, dt_s);

    Command command;
    command.segment = Segment(X_WB.p());
    command.dwelling = phase_ == Phase::kDwell;
    command.done = phase_ == Phase::kDone;
    command.twist = twist_;
    return command;
  }

 private:
  enum class Phase { kDrive, kTurn, kDwell, kDone };

  static double Radians(double deg) { return deg * kPi / 180; }

  static void Require(const RobotSpec& robot, const std::string& key, double value) {
    if (!(value > 0))
      throw InputError({robot.model_file, 0}, key, FormatDouble(value),
                       "must be > 0 for the tracker regulated_pursuit");
  }

  const ReferenceVertex& Vertex(std::size_t i) const { return reference_.vertices[i]; }

  // Leaves legs whose end is passed, and stops at a corner that is reached.
  void Advance(const Vec2& p_W, double t_s) {
    if (homing_) {
      if ((Vertex(goal_).p_W - p_W).norm() <= 2 * corner_tolerance_m_) Arrive(goal_, t_s);
      return;
    }
    while (true) {
      const ReferenceVertex &from = Vertex(vertex_), &to = Vertex(vertex_ + 1);
      const Vec2 passed = p_W - to.p_W;
      if (to.stop) {
        if (passed.dot(from.direction_W) < -corner_tolerance_m_) return;
        if (std::abs(Cross(from.direction_W, passed)) <= kBesideCornerM) {
          Arrive(vertex_ + 1, t_s);
        } else {
          homing_ = true;
          goal_ = vertex_ + 1;
        }
        return;
      }
      // A bend is passed at its bisector; far off, the plane alone would skip whole loops.
      if (passed.dot(from.direction_W + to.direction_W) < 0 || passed.norm() > kBendGateM) return;
      ++vertex_;
    }
  }

  void Arrive(std::size_t vertex, double t_s) {
    vertex_ = ahead_ = vertex;
    homing_ = false;
    if (Vertex(vertex).dwell_s > 0) {
      phase_ = Phase::kDwell;
      dwell_until_s_ = t_s + Vertex(vertex).dwell_s;
    } else {
      Depart();
    }
  }

  void Depart() {
    phase_ = vertex_ + 1 < reference_.vertices.size() ? Phase::kTurn : Phase::kDone;
    turn_side_ = 0;
  }

  // The way along the legs that p_W has come, not before the leg now tracked.
  double Progress(const Vec2& p_W) const {
    const ReferenceVertex& from = Vertex(vertex_);
    if (homing_ || vertex_ + 1 == reference_.vertices.size()) return from.s_m;
    const double leg_m = Vertex(vertex_ + 1).s_m - from.s_m;
    return from.s_m + std::clamp((p_W - from.p_W).dot(from.direction_W), 0.0, leg_m);
  }

  // The plan's segment that holds this progress; never one of no length.
  std::size_t Segment(const Vec2& p_W) {
    const std::size_t n = reference_.waypoint_s_m.size();
    if (n < 2) return 0;
    const double s_m = Progress(p_W);
    while (waypoint_ + 2 < n && reference_.waypoint_s_m[waypoint_ + 1] <= s_m) ++waypoint_;
    return waypoint_;
  }

  // The point `way_m` ahead; beyond a stop it lies on the leg's prolongation, so that the robot
  // arrives straight.
  Vec2 PointAhead(const Vec2& p_W, double way_m) {
    const double s_m = Progress(p_W) + way_m;
    ahead_ = std::max(ahead_, vertex_);
    while (ahead_ > vertex_ && Vertex(ahead_).s_m > s_m) --ahead_;
    while (!Vertex(ahead_ + 1).stop && Vertex(ahead_ + 1).s_m <= s_m) ++ahead_;
    return Vertex(ahead_).p_W + (s_m - Vertex(ahead_).s_m) * Vertex(ahead_).direction_W;
  }

  // Where to, and how fast at most: the point pursued and the speed that the way ahead allows.
  void Pursue(const Pose2& X_WB, double dt_s) {
    const Vec2 p_W = X_WB.p();
    Vec2 target_W;
    double speed_mps;
    if (homing_) {
      target_W = Vertex(goal_).p_W;
      speed_mps =
          std::min(limits_.cruise_mps,
                   ApproachSpeed(0, (target_W - p_W).norm() - corner_tolerance_m_, limits_));
    } else {
      const ReferenceVertex &from = Vertex(vertex_), &to = Vertex(vertex_ + 1);
      const double speed_for_way_mps =
          phase_ == Phase::kTurn ? from.speed_mps : std::abs(twist_.vx_mps);
      target_W = PointAhead(p_W, std::clamp(speed_for_way_mps * lookahead_s_, lookahead_min_m_,
                                            std::max(lookahead_min_m_, lookahead_max_m_)));
      const double left_m = (to.p_W - p_W).dot(from.direction_W);
      speed_mps = std::min(from.speed_mps, ApproachSpeed(to.passing_mps, left_m, limits_));
    }
    const Vec2 target_B = X_WB.Inverse() * target_W;
    const double aside_rad = std::atan2(target_B.y(), target_B.x());
    if (phase_ == Phase::kDrive && std::abs(aside_rad) > Radians(recover_deg_)) {
      phase_ = Phase::kTurn;
      turn_side_ = 0;
    }
    if (phase_ == Phase::kTurn && std::abs(aside_rad) <= Radians(heading_tolerance_deg_))
      phase_ = Phase::kDrive;
    if (phase_ == Phase::kTurn)
      Turn(aside_rad, dt_s);
    else
      Follow(target_B, std::min(speed_mps, ObstacleSpeed(speed_mps, p_W, target_W)), dt_s);
  }

  void Turn(double aside_rad, double dt_s) {
    if (std::abs(aside_rad) < kAboutFaceRad || turn_side_ == 0) turn_side_ = aside_rad < 0 ? -1 : 1;
    const double b = yaw_accel_radps2_ * kDecelShare * kLagS;
    const double rate =
        std::sqrt(b * b + 2 * kDecelShare * yaw_accel_radps2_ * std::abs(aside_rad)) - b;
    Slew(0, turn_side_ * std::min(yaw_rate_radps_, rate), dt_s);
  }

  void Follow(const Vec2& target_B, double speed_mps, double dt_s) {
    const double curvature = 2 * target_B.y() / std::max(target_B.squaredNorm(), 1e-9);
    speed_mps = std::min(speed_mps, limits_.yaw_rate_radps / std::max(std::abs(curvature), 1e-9));
    Slew(speed_mps, std::nullopt, dt_s, curvature);
  }

  // Slower the smaller the gap, here and where the robot is heading.
  double ObstacleSpeed(double speed_mps, const Vec2& p_W, const Vec2& target_W) const {
    if (clearance_ == nullptr || obstacle_gap_m_ <= 0) return speed_mps;
    const double gap_m = std::min(clearance_->At(p_W), clearance_->At(target_W)) - clear_radius_m_;
    const double share = std::clamp(gap_m / obstacle_gap_m_, 0.0, 1.0);
    return speed_mps * (obstacle_share_ + (1 - obstacle_share_) * share);
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
  double lookahead_s_ = 0.65, lookahead_min_m_ = 0.12, lookahead_max_m_ = 0.4;
  double corner_cut_m_ = 0.02, corner_tolerance_m_ = 0.01;
  double heading_tolerance_deg_ = 1.5, recover_deg_ = 70;
  double obstacle_gap_m_ = 0.10, obstacle_share_ = 0.6;

  ReferenceLimits limits_;
  ReferencePath reference_;
  const ClearanceField* clearance_ = nullptr;
  double clear_radius_m_ = 0;
  double accel_mps2_ = 0, yaw_rate_radps_ = 0, yaw_accel_radps2_ = 0;

  Phase phase_ = Phase::kDone;
  bool homing_ = false;  // going to vertex goal_ itself instead of along the leg
  std::size_t goal_ = 0;
  std::size_t vertex_ = 0;    // the leg now tracked goes from here to the next
  std::size_t ahead_ = 0;     // the leg that holds the point pursued
  std::size_t waypoint_ = 0;  // the plan's segment now tracked
  BodyTwist twist_;           // last commanded
  int turn_side_ = 0;
  double dwell_until_s_ = 0;
};

}  // namespace

FP_DEFINE_PLUGIN(Tracker, RegulatedPursuit)

}  // namespace floorproof
