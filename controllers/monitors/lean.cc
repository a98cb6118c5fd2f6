// SPDX-License-Identifier: Apache-2.0
// A robot that has come to lean otherwise than at its start: a load has shifted, a spring has
// broken, a wheel is off. The mean of where the accelerometer says that down is, over a while in
// which hazards are crossed and speeds change, beside that of the first such while. What the known
// map's ramps make it lean, where it thinks that it is, is taken off: the slope under its middle
// and around. On a ramp that no map knows it cannot tell the floor's lean from its load's.
#include <algorithm>
#include <cmath>

#include "controllers/monitors/monitor.h"
#include "env/core/slopes.h"
#include "env/core/standing.h"

namespace floorproof {
namespace {

class Lean final : public Monitor {
 public:
  Lean() : Monitor({.hold_s = 2}) {}
  MonitorKind kind() const override { return MonitorKind::kTrend; }
  std::string_view unit() const override { return "deg"; }
  std::vector<Reading> Needs() const override { return {Reading::kImu}; }

  void Update(const MonitorReadings& now) override {
    if (!now.has_imu) return;
    const Vec2 lean = now.accel_mps2.normalized().head<2>() - FloorsLean(now.estimate.X_WB);
    const double ahead = ahead_.Update(lean.x(), now.dt_s, mean_s_),
                 aside = aside_.Update(lean.y(), now.dt_s, mean_s_);
    heard_s_ += now.dt_s;
    if (heard_s_ < 2 * mean_s_) {
      first_ = {ahead, aside};
      return;
    }
    const double off_deg =
        std::asin(std::min(1.0, (Vec2(ahead, aside) - first_).norm())) * 180 / kPi;
    const bool bad = off_deg > limit_deg_;
    alarm().Update(now.t_s, now.dt_s, bad, !bad, off_deg, limit_deg_);
  }

 private:
  void VisitOwn(ParamVisitor& v) override {
    v("limit_deg", limit_deg_, Between(0, 180), "most change (deg)");
    v("mean_s", mean_s_, Positive(), "time constant of the mean (s)");
  }
  void StartOwn(const MonitorContext& context) override {
    known_ = &context.known;
    const auto is_ramp = [](const Hazard& hazard) { return IsRamp(hazard); };
    has_ramps_ = std::ranges::any_of(known_->hazards, is_ramp);
    around_m_ = kAround * context.robot.inscribed_radius_m;
    ahead_.Reset();
    aside_.Reset();
    heard_s_ = 0;
    first_ = Vec2::Zero();
  }

  // What upwards is in the body frame, of a robot that stands on the known floor there.
  Vec2 FloorsLean(const Pose2& X_WB) const {
    if (!has_ramps_) return Vec2::Zero();
    Vec2 gradient_W = Vec2::Zero();
    for (const Vec2& p_B : {Vec2(1, 1), Vec2(1, -1), Vec2(-1, 1), Vec2(-1, -1)})
      gradient_W += GroundAt(*known_, X_WB * Vec2(around_m_ * p_B)).gradient / 4;
    return Pose2{0, 0, -X_WB.yaw_rad}.Rotate(gradient_W) / std::sqrt(1 + gradient_W.squaredNorm());
  }

  static constexpr double kAround = 0.7;  // of the radius: about where wheels are
  double limit_deg_ = 1.5, mean_s_ = 2, around_m_ = 0;
  const HazardMap* known_ = nullptr;
  bool has_ramps_ = false;
  LowPass ahead_, aside_;
  double heard_s_ = 0;
  Vec2 first_ = Vec2::Zero();
};

}  // namespace

FP_DEFINE_PLUGIN(Monitor, Lean)

}  // namespace floorproof
