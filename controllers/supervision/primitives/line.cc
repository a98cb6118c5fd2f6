// SPDX-License-Identifier: Apache-2.0
// Drives straight from where it thinks it is to a place, by the scenario's tracker.
#include "controllers/supervision/primitives/target.h"
#include "controllers/supervision/robot_primitive.h"

namespace floorproof {
namespace {

class Line final : public RobotPrimitive {
 public:
  Line() : RobotPrimitive("it has not come nearer in P1") {}
  bool moves() const override { return true; }
  void VisitOwn(ParamVisitor& v) override {
    target_.Visit(v);
    v("speed_mps", speed_mps_, Positive(), "v_n: nominal speed (m/s); none: the robot's cruise");
    getting_on_.Visit(v);
  }

  std::optional<AskedLine> LeadsTo() const override {
    const auto to_W = target_.p_W();
    if (!to_W) throw InputError({}, "x_m, y_m", "", "are missing: where the line leads to");
    return AskedLine{0, *to_W, speed_mps_};
  }

  void Start(double) override {
    getting_on_.Start();
    Begin();
  }
  NodeStatus Update(double) override {
    constexpr double kLess_m = 0.005;
    const double left_m = (*target_.p_W() - now().estimate.X_WB.p()).norm();
    getting_on_.Update(now().dt_s, left_m, kLess_m, board().speed_share, board().busy);
    if (left_m <= target_.tolerance_m) return NodeStatus::kDone;
    MotionWish& wish = board().wish;
    const bool begun = wish.kind == MotionWish::Kind::kLine;
    if (begun && board().at_end) Begin();  // the tracker is content, and it is not there
    return NodeStatus::kRunning;
  }

 private:
  void Begin() {
    MotionWish& wish = board().wish;
    wish.kind = MotionWish::Kind::kLine;
    wish.line = {wish.line.number + 1, *target_.p_W(), speed_mps_};
    board().at_end = false;
  }
  std::optional<Persistence> FailsItself() const override { return getting_on_.fails(); }

  Target target_;
  std::optional<double> speed_mps_;
  GettingOn getting_on_;
};

}  // namespace

FP_DEFINE_PLUGIN(RobotPrimitive, Line)

}  // namespace floorproof
