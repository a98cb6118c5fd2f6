// SPDX-License-Identifier: Apache-2.0
// The turn that the wheels' speeds make, beside the gyro's: a wheel that slips, a body that is
// turned by something else.
#include <cmath>

#include "controllers/monitors/monitor.h"
#include "controllers/odometry.h"

namespace floorproof {
namespace {

class YawRate final : public Monitor {
 public:
  YawRate() : Monitor({.hold_s = 0.3}) {}
  MonitorKind kind() const override { return MonitorKind::kProcessModel; }
  std::string_view unit() const override { return "rad/s"; }
  std::vector<Reading> Needs() const override { return {Reading::kWheels, Reading::kImu}; }

  void Update(const MonitorReadings& now) override {
    if (!now.has_imu) return;
    const double by_wheels =
        RolledTwist(*drive_, now.wheel_rad, now.hinges, now.dt_s, radps_).wz_radps;
    const double off = std::abs(off_.Update(by_wheels - now.gyro_radps.z(), now.dt_s, smooth_s_));
    const bool bad = off > limit_radps_;
    const bool moves =
        now.commanded.vx_mps != 0 || now.commanded.vy_mps != 0 || now.commanded.wz_radps != 0;
    alarm().Update(now.t_s, now.dt_s, bad, !bad && moves, off, limit_radps_);
  }

 private:
  void VisitOwn(ParamVisitor& v) override {
    v("limit_radps", limit_radps_, Positive(), "most difference (rad/s)");
    v("smooth_s", smooth_s_, NonNegative(), "time constant of its smoothing (s)");
  }
  void StartOwn(const MonitorContext& context) override {
    drive_ = &context.drive;
    radps_.assign(context.robot.wheels.size(), 0);
    off_.Reset();
  }

  double limit_radps_ = 0.2, smooth_s_ = 0.2;
  const Drive* drive_ = nullptr;
  std::vector<double> radps_;
  LowPass off_;
};

}  // namespace

FP_DEFINE_PLUGIN(Monitor, YawRate)

}  // namespace floorproof
