// SPDX-License-Identifier: Apache-2.0
// Watches the body's acceleration in the plane of its floor while others drive, by the IMU, without
// gravity, which a slope adds to what an accelerometer measures: "if the acceleration is greater
// than the maximum allowed for more than P2 seconds, there is an intermittent fault"
// ("safety-monitoring", section 4).
#include "controllers/monitors/upwards.h"
#include "controllers/supervision/robot_primitive.h"

namespace floorproof {
namespace {

class AccelerationControl final : public RobotPrimitive {
 public:
  AccelerationControl() : RobotPrimitive("the body was jolted for longer than P2") {}
  bool moves() const override { return false; }
  void VisitOwn(ParamVisitor& v) override {
    v("max_accel_mps2", max_mps2_, Positive(), "the most that is allowed (m/s^2)");
    v("p2_s", timing_.hold_s, NonNegative(), "P2: for longer is a fault (s)");
  }

  void Start(double) override {
    alarm_ = Alarm(timing_);
    ahead_.Reset();
    aside_.Reset();
    upwards_.Reset();
  }
  NodeStatus Update(double t_s) override {
    if (!now().has_imu) return NodeStatus::kRunning;
    constexpr double kSmooth_s = 0.1;
    constexpr double kGravity_mps2 = 9.81;
    const double dt_s = now().dt_s;
    const Vec3 accel = now().accel_mps2 -
                       kGravity_mps2 * upwards_.Update(now().gyro_radps, now().accel_mps2, dt_s);
    const Vec2 a(ahead_.Update(accel.x(), dt_s, kSmooth_s),
                 aside_.Update(accel.y(), dt_s, kSmooth_s));
    const bool bad = a.norm() > max_mps2_;
    alarm_.Update(t_s, dt_s, bad, !bad, a.norm(), max_mps2_);
    return NodeStatus::kRunning;
  }

 private:
  std::optional<Persistence> FailsItself() const override {
    return alarm_.raised() ? std::optional(alarm_.persistence()) : std::nullopt;
  }

  double max_mps2_ = 1.5;
  AlarmTiming timing_{.hold_s = 0.3};
  Alarm alarm_;
  Upwards upwards_;
  LowPass ahead_, aside_;
};

}  // namespace

FP_DEFINE_PLUGIN(RobotPrimitive, AccelerationControl)

}  // namespace floorproof
