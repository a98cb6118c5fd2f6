// SPDX-License-Identifier: Apache-2.0
// A robot that has come to lean otherwise than at its start: a load has shifted, a spring has
// broken, a wheel is off. The mean of where the accelerometer says that down is, over a while in
// which hazards are crossed and speeds change, beside that of the first such while.
#include <algorithm>
#include <cmath>

#include "controllers/monitors/monitor.h"

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
    const Vec3 up = now.accel_mps2.normalized();
    const double ahead = ahead_.Update(up.x(), now.dt_s, mean_s_),
                 aside = aside_.Update(up.y(), now.dt_s, mean_s_);
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
  void StartOwn(const MonitorContext&) override {
    ahead_.Reset();
    aside_.Reset();
    heard_s_ = 0;
    first_ = Vec2::Zero();
  }

  double limit_deg_ = 1.5, mean_s_ = 2;
  LowPass ahead_, aside_;
  double heard_s_ = 0;
  Vec2 first_ = Vec2::Zero();
};

}  // namespace

FP_DEFINE_PLUGIN(Monitor, Lean)

}  // namespace floorproof
