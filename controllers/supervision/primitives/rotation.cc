// SPDX-License-Identifier: Apache-2.0
// Turns on the spot. Away from the place to go to it turns to face it; there, to the final heading.
// So Rotation-Line-Rotation uses the same primitive twice ("safety-monitoring", figure 8).
#include <cmath>

#include "controllers/supervision/primitives/target.h"
#include "controllers/supervision/robot_primitive.h"

namespace floorproof {
namespace {

class Rotation final : public RobotPrimitive {
 public:
  Rotation() : RobotPrimitive("it has not turned nearer in P1") {}
  bool moves() const override { return true; }
  void VisitOwn(ParamVisitor& v) override {
    target_.Visit(v);
    v("yaw_deg", yaw_deg_, Between(-360, 360), "theta: final heading (deg); none: as it came");
    v("tolerance_deg", tolerance_deg_, Between(0.1, 180), "epsilon: how near is there (deg)");
    getting_on_.Visit(v);
  }

  void Start(double) override {
    getting_on_.Start();
    const Pose2& X_WB = now().estimate.X_WB;
    const Vec2 way_W = target_.p_W().value_or(X_WB.p()) - X_WB.p();
    if (way_W.norm() > target_.tolerance_m)
      yaw_rad_ = std::atan2(way_W.y(), way_W.x());
    else
      yaw_rad_ = yaw_deg_ ? *yaw_deg_ * kPi / 180 : X_WB.yaw_rad;
  }
  NodeStatus Update(double) override {
    constexpr double kLess_rad = 0.01, kSlow_radps = 0.05;
    const Estimate& estimate = now().estimate;
    const double left_rad = std::abs(WrapAngle(yaw_rad_ - estimate.X_WB.yaw_rad));
    getting_on_.Update(now().dt_s, left_rad, kLess_rad, board().speed_share, false);
    board().wish.kind = MotionWish::Kind::kTurn;
    board().wish.yaw_rad = yaw_rad_;
    const bool there =
        left_rad <= tolerance_deg_ * kPi / 180 && std::abs(estimate.V_WB_B.wz_radps) < kSlow_radps;
    return there ? NodeStatus::kDone : NodeStatus::kRunning;
  }

 private:
  std::optional<Persistence> FailsItself() const override { return getting_on_.fails(); }

  Target target_;
  std::optional<double> yaw_deg_;
  double tolerance_deg_ = 2, yaw_rad_ = 0;
  GettingOn getting_on_;
};

}  // namespace

FP_DEFINE_PLUGIN(RobotPrimitive, Rotation)

}  // namespace floorproof
