// SPDX-License-Identifier: Apache-2.0
// The way that the wheels' turns make in a while, beside the way that the estimate made: they
// differ where wheels spin, where encoders are not heard, and where the robot was carried. To an
// estimator that goes by the wheels alone they never do.
#include <algorithm>
#include <cmath>

#include "controllers/monitors/monitor.h"
#include "controllers/odometry.h"

namespace floorproof {
namespace {

class Slip final : public Monitor {
 public:
  Slip() : Monitor({.hold_s = 0.2}) {}
  bool by_estimate() const override { return true; }
  MonitorKind kind() const override { return MonitorKind::kProcessModel; }
  std::string_view unit() const override { return "m"; }
  std::vector<Reading> Needs() const override { return {Reading::kWheels}; }

  void Update(const MonitorReadings& now) override {
    const BodyTwist twist = RolledTwist(*drive_, now.wheel_rad, now.hinges, now.dt_s, radps_);
    rolled_W_ += now.estimate.X_WB.Rotate({twist.vx_mps, twist.vy_mps}) * now.dt_s;
    since_s_ += now.dt_s;
    if (since_s_ < window_s_ / kSlots) return;
    since_s_ = 0;
    // The oldest of the ring is a window old.
    const Place then = ring_[next_];
    ring_[next_] = {now.estimate.X_WB.p(), rolled_W_};
    next_ = (next_ + 1) % kSlots;
    filled_ = std::min(filled_ + 1, kSlots + 1);
    if (filled_ <= kSlots) return;
    const double off_m = ((now.estimate.X_WB.p() - then.p_W) - (rolled_W_ - then.rolled_W)).norm();
    const bool bad = off_m > limit_m_;
    const bool moves = now.commanded.vx_mps != 0 || now.commanded.vy_mps != 0;
    alarm().Update(now.t_s, window_s_ / kSlots, bad, !bad && moves, off_m, limit_m_);
  }

 private:
  static constexpr int kSlots = 10;
  struct Place {
    Vec2 p_W = Vec2::Zero(), rolled_W = Vec2::Zero();
  };
  void VisitOwn(ParamVisitor& v) override {
    v("limit_m", limit_m_, Positive(), "most difference of the ways (m)");
    v("window_s", window_s_, Between(0.1, 60), "in this time (s)");
  }
  void StartOwn(const MonitorContext& context) override {
    drive_ = &context.drive;
    radps_.assign(context.robot.wheels.size(), 0);
    ring_.assign(kSlots, {});
    rolled_W_ = Vec2::Zero();
    next_ = filled_ = 0;
    since_s_ = 0;
  }

  double limit_m_ = 0.2, window_s_ = 2;
  const Drive* drive_ = nullptr;
  std::vector<double> radps_;
  std::vector<Place> ring_;
  Vec2 rolled_W_ = Vec2::Zero();
  int next_ = 0, filled_ = 0;
  double since_s_ = 0;
};

}  // namespace

FP_DEFINE_PLUGIN(Monitor, Slip)

}  // namespace floorproof
