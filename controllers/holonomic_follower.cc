// SPDX-License-Identifier: Apache-2.0
// Path following for holonomic robots: the heading is the plan's, and not the direction of travel.
//
// The body's velocity has two parts. The first is the path's own velocity a moment ahead
// (feed-forward: a robot needs that moment to change its velocity). The second leads back to the
// path in proportion to the distance from it (feedback, gain_per_s); the larger it is, the slower
// the robot drives along the path. The yaw is the one that the plan states for the leg, or the
// direction of travel where the plan leaves it open (env/core/path.h). Speed is bounded by the
// passing speeds of the bends ahead, by rests at corners (path_progress.h) and by the gap to known
// obstacles. A robot that an edge holds gives way to it (compliance.h). At a stop the robot first
// turns to its next yaw, holding its place. After Kanayama, Kimura, Miyazaki & Noguchi 1990, "A
// stable tracking control method for an autonomous mobile robot", without the nonholonomic part.
// Where the plan changes the shape of a robot of hinged blocks, the robot stops, holds its place
// and folds (reconfiguration.h). Assumes a drive that turns and moves at once; does not plan around
// obstacles.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "controllers/compliance.h"
#include "controllers/creep.h"
#include "controllers/drive.h"
#include "controllers/drive_time.h"
#include "controllers/follower_params.h"
#include "controllers/path_progress.h"
#include "controllers/reconfiguration.h"
#include "controllers/tracker.h"

namespace floorproof {
namespace {

constexpr double kGapAhead_m = 0.1;     // the gap is read here and this far ahead
constexpr double kHold_m = 0.05;        // a turn within this of its corner
constexpr double kHoldGain = 1.5;       // 1/s: is kept there with this gain
constexpr double kBearableShare = 0.8;  // of recover_deg, by a robot that an edge turns

class HolonomicFollower final : public Tracker {
 public:
  void Visit(ParamVisitor& v) override {
    const FollowerHelp help{"corners sharper than this are stops",
                            "when the yaw is wrong by more than this the robot stops and turns", 5};
    params_.Visit(v, help, [&] {
      v("anticipation_s", anticipation_s_, Between(0, 1),
        "how long before a bend its direction is taken");
      v("gain_per_s", gain_per_s_, Between(0.1, 10),
        "speed back to the path for each metre off it");
    });
  }

  bool Commands(const Drive& drive) const override { return drive.holonomic(); }

  void Start(const Path& path, const RobotSpec& robot, const ClearanceField* clearance) override {
    RequireLimits(robot, "holonomic_follower");
    gap_.Start(params_.obstacles, robot, clearance);
    cruise_mps_ = robot.cruise_mps;
    accel_mps2_ = robot.max_accel_mps2;
    yaw_rate_radps_ = robot.max_yaw_rate_radps;
    yaw_accel_radps2_ = robot.max_yaw_accel_radps2;

    ReferenceLimits limits = params_.Limits(robot);
    limits.holds_yaw = true;
    limits.folds = !robot.hinges.empty();
    progress_.Start(path, limits, params_.corner_tolerance_m);
    turn_creep_.Reset();
    compliance_.Start(robot, kBearableShare * Radians(params_.recover_deg));
    twist_ = {};
    share_ = 1;
    reconfiguration_.Start(robot);
    FindWays(robot);
    duration_s_ = DriveTime(progress_.reference(),
                            {limits, params_.corner_tolerance_m,
                             Radians(params_.heading_tolerance_deg), Radians(params_.recover_deg)},
                            robot);
    duration_s_ += gap_.Delay(progress_.reference());
    for (const HingeWay& way : ways_) duration_s_ += reconfiguration_.Duration(way);
  }

  void Extend(const Path& path) override {
    progress_.Extend(path);
    turn_creep_.Reset();
    ways_.assign(progress_.reference().vertices.size(), {});
  }

  void Slow(double share) override {
    share_ = share;
    progress_.Slow(share);
  }

  double Duration() const override { return duration_s_; }

  Command Update(const Estimate& estimate, double t_s, double dt_s) override {
    const Pose2& X_WB = estimate.X_WB;
    const std::size_t vertex = progress_.vertex();
    progress_.Update(X_WB, t_s);
    if (progress_.vertex() != vertex || progress_.phase() != Phase::kTurn) turn_creep_.Reset();
    Fold(X_WB.yaw_rad);
    if (progress_.moving())
      Pursue(X_WB, t_s, dt_s);
    else if (folding_)
      HoldPlace(X_WB, dt_s);
    else
      Slew(Vec2::Zero(), 0, dt_s);

    Command command;
    command.hinges = reconfiguration_.Update(estimate.hinges, dt_s);
    command.segment = progress_.Segment(X_WB.p());
    command.dwelling = progress_.phase() == Phase::kDwell;
    command.tasks = progress_.tasks();
    command.turning = progress_.phase() == Phase::kTurn || progress_.phase() == Phase::kFold;
    command.done = progress_.phase() == Phase::kDone;
    command.twist = twist_;
    return command;
  }

 private:
  using Phase = PathProgress::Phase;

  // Searches the folding of every change of shape before the drive.
  void FindWays(const RobotSpec& robot) {
    const auto& vertices = progress_.reference().vertices;
    ways_.assign(vertices.size(), {});
    folding_ = false;
    int shape = robot.shape;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      for (const std::string& name : vertices[i].shapes) {
        const int next = FindShape(robot, name);
        if (next < 0) throw InputError({}, "shape", name, "is none of the robot's");
        const auto angles = [&](int k) -> const std::vector<double>& {
          return robot.shapes[static_cast<std::size_t>(k)].hinge_rad;
        };
        const HingeWay way = FoldingWay(robot, angles(shape), angles(next));
        if (way.empty()) throw InputError({}, "shape", name, "cannot be reached by folding");
        ways_[i].insert(ways_[i].end(), way.begin() + (ways_[i].empty() ? 0 : 1), way.end());
        shape = next;
      }
    }
  }

  void Fold(double yaw_rad) {
    if (progress_.phase() != Phase::kFold) return;
    if (!folding_) {
      reconfiguration_.Fold(ways_[progress_.vertex()]);
      hold_yaw_rad_ = yaw_rad;
      folding_ = true;
    } else if (reconfiguration_.done()) {
      folding_ = false;
      progress_.Folded();
    }
  }

  // Stays at the vertex, with the heading with which it came.
  void HoldPlace(const Pose2& X_WB, double dt_s) {
    const Vec2 back_W = progress_.leg().p_W - X_WB.p();
    const Vec2 v_W = kHoldGain * std::min(1.0, kHold_m / std::max(back_W.norm(), 1e-12)) * back_W;
    Slew(Pose2{0, 0, -X_WB.yaw_rad}.Rotate(v_W),
         kHoldGain * WrapAngle(hold_yaw_rad_ - X_WB.yaw_rad), dt_s);
  }

  void Pursue(const Pose2& X_WB, double t_s, double dt_s) {
    const Vec2 p_W = X_WB.p();
    const double ahead_m = anticipation_s_ * std::hypot(twist_.vx_mps, twist_.vy_mps);
    const auto [direction_W, offset_W, speed_mps] = progress_.CourseFrom(p_W, ahead_m);
    const double wanted_rad =
        progress_.leg().yaw_rad.value_or(std::atan2(direction_W.y(), direction_W.x()));
    const double off_rad = WrapAngle(wanted_rad - X_WB.yaw_rad);
    if (progress_.phase() == Phase::kDrive && std::abs(off_rad) > Radians(params_.recover_deg))
      progress_.Turn(p_W);
    if (progress_.phase() == Phase::kTurn &&
        std::abs(off_rad) <= Radians(params_.heading_tolerance_deg))
      progress_.Drive();

    GiveWay(X_WB, direction_W, dt_s);
    const double turn_rad = compliance_.YawError(off_rad);
    const bool turns_on_the_spot = progress_.phase() == Phase::kTurn;
    if (turns_on_the_spot && share_ > 0) turn_creep_.Update(std::abs(off_rad), t_s);
    const double rate = TurningRate(turn_rad, yaw_rate_radps_, yaw_accel_radps2_,
                                    turns_on_the_spot ? turn_creep_.speed() : 0);
    const double wz_radps =
        std::clamp(turn_rad == 0 ? compliance_.SquaringRate() : std::copysign(rate, turn_rad),
                   -yaw_rate_radps_, yaw_rate_radps_);
    Vec2 v_W;
    if (progress_.phase() == Phase::kTurn) {
      const Vec2 back_W = progress_.turn_W() - p_W;
      v_W = back_W.norm() < kHold_m ? Vec2(kHoldGain * back_W) : Vec2(Vec2::Zero());
    } else {
      const double limit_mps = gap_.Limit(speed_mps, X_WB, p_W + kGapAhead_m * direction_W);
      const double back_mps =
          std::min(gain_per_s_ * offset_W.norm(), compliance_.BackSpeed(limit_mps, cruise_mps_));
      v_W = offset_W.normalized() * back_mps +
            direction_W * std::sqrt(std::max(0.0, limit_mps * limit_mps - back_mps * back_mps));
    }
    Slew(Pose2{0, 0, -X_WB.yaw_rad}.Rotate(v_W), wz_radps, dt_s);
  }

  void GiveWay(const Pose2& X_WB, const Vec2& direction_W, double dt_s) {
    if (progress_.phase() == Phase::kTurn) {
      compliance_.Drop();
      return;
    }
    const Vec2 v_W = X_WB.Rotate({twist_.vx_mps, twist_.vy_mps});
    compliance_.Update(X_WB.p(), direction_W, v_W.dot(direction_W), dt_s);
  }

  // Moves the command towards what is wanted as fast as the robot's accelerations allow.
  void Slew(const Vec2& v_B, double wz_radps, double dt_s) {
    const Vec2 last(twist_.vx_mps, twist_.vy_mps);
    Vec2 change = share_ * v_B - last;
    change *= std::min(1.0, accel_mps2_ * dt_s / std::max(change.norm(), 1e-12));
    twist_.vx_mps = last.x() + change.x();
    twist_.vy_mps = last.y() + change.y();
    const double dw = yaw_accel_radps2_ * dt_s;
    twist_.wz_radps = std::clamp(share_ * wz_radps, twist_.wz_radps - dw, twist_.wz_radps + dw);
  }

  FollowerParams params_{.corner_cut_m = 0.003,
                         .corner_tolerance_m = 0.004,
                         .heading_tolerance_deg = 1.0,
                         .recover_deg = 15};
  // The wheels' lag, and half of the time that the change of velocity in a bend takes.
  double anticipation_s_ = 0.1, gain_per_s_ = 2.5;

  ObstacleGap gap_;
  PathProgress progress_;
  Compliance compliance_;
  Creep turn_creep_{Creep::kTurn};
  double cruise_mps_ = 0, accel_mps2_ = 0, yaw_rate_radps_ = 0, yaw_accel_radps2_ = 0;
  BodyTwist twist_;  // last commanded
  double share_ = 1;

  Reconfiguration reconfiguration_;
  std::vector<HingeWay> ways_;  // by vertex: of the change of shape there, if any
  bool folding_ = false;
  double hold_yaw_rad_ = 0;
  double duration_s_ = 0;
};

}  // namespace

FP_DEFINE_PLUGIN(Tracker, HolonomicFollower)

}  // namespace floorproof
