// SPDX-License-Identifier: Apache-2.0
// How far the robot leans: the gyro's turns about its own axes, held to where the accelerometer
// says that down is (a complementary filter; Mahony, Hamel & Pflimlin, "Nonlinear complementary
// filters on the special orthogonal group", 2008).
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "controllers/monitors/monitor.h"

namespace floorproof {
namespace {

class Tilt final : public Monitor {
 public:
  Tilt() : Monitor({.hold_s = 0.1}) {}
  MonitorKind kind() const override { return MonitorKind::kLimit; }
  std::string_view unit() const override { return "deg"; }
  std::vector<Reading> Needs() const override { return {Reading::kImu}; }

  void Update(const MonitorReadings& now) override {
    if (!now.has_imu) return;
    const Vec3 by_force = now.accel_mps2.normalized();
    if (up_B_.isZero()) up_B_ = by_force;
    up_B_ += up_B_.cross(now.gyro_radps) * now.dt_s;
    up_B_ += (by_force - up_B_) * (now.dt_s / (time_s_ + now.dt_s));
    up_B_.normalize();
    const double tilt_deg = std::acos(std::clamp(up_B_.z(), -1.0, 1.0)) * 180 / kPi;
    const bool bad = tilt_deg > limit_deg_;
    alarm().Update(now.t_s, now.dt_s, bad, !bad, tilt_deg, limit_deg_);
  }

 private:
  void VisitOwn(ParamVisitor& v) override {
    v("limit_deg", limit_deg_, Between(0, 180), "the most (deg)");
    v("time_s", time_s_, Positive(), "in which the accelerometer has its way (s)");
  }
  void StartOwn(const MonitorContext&) override { up_B_ = Vec3::Zero(); }

  double limit_deg_ = 12, time_s_ = 1;
  Vec3 up_B_ = Vec3::Zero();
};

}  // namespace

FP_DEFINE_PLUGIN(Monitor, Tilt)

}  // namespace floorproof
