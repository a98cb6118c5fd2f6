// SPDX-License-Identifier: Apache-2.0
// Drives the scenario's plan, whoever made it. A robot that stands or turns on purpose gets on;
// else it must come away from where it is in P1.
#include "controllers/supervision/robot_primitive.h"

namespace floorproof {
namespace {

constexpr double kAway_m = 0.1, kTurned_rad = 0.3;

class FollowPlan final : public RobotPrimitive {
 public:
  FollowPlan() : RobotPrimitive("it has not come away from where it is in P1") {}
  bool moves() const override { return true; }
  void VisitOwn(ParamVisitor& v) override { getting_on_.Visit(v); }

  bool drives_plan() const override { return true; }

  void Start(double) override {
    getting_on_.Start();
    was_ = now().estimate.X_WB;
  }
  NodeStatus Update(double) override {
    board().wish.kind = MotionWish::Kind::kPlan;
    const Pose2& X_WB = now().estimate.X_WB;
    const bool away = (X_WB.p() - was_.p()).norm() > kAway_m ||
                      std::abs(WrapAngle(X_WB.yaw_rad - was_.yaw_rad)) > kTurned_rad;
    if (away) {
      was_ = X_WB;
      getting_on_.GotOn();
    }
    getting_on_.Update(now().dt_s, 0, 0, board().speed_share, board().busy);
    return board().at_end ? NodeStatus::kDone : NodeStatus::kRunning;
  }

 private:
  std::optional<Persistence> FailsItself() const override { return getting_on_.fails(); }

  GettingOn getting_on_;
  Pose2 was_;
};

}  // namespace

FP_DEFINE_PLUGIN(RobotPrimitive, FollowPlan)

}  // namespace floorproof
