// SPDX-License-Identifier: Apache-2.0
// A motor that draws another current than its driver's law gives: i = gain (told - turns) / K, as
// far as the battery's voltage and the driver's limits allow (DriveTorque). Both speeds are
// measured at the wheel, so that what loads it does not matter. Of a wheel that chatters, as one
// that spins before a wall, nothing is told: within a period its driver is at one limit and at the
// other, and the means do not keep the law.
#include <cmath>
#include <utility>

#include "controllers/monitors/monitor.h"

namespace floorproof {
namespace {

class MotorCurrent final : public Monitor {
 public:
  MotorCurrent() : Monitor({.hold_s = 0.2}) {}
  MonitorKind kind() const override { return MonitorKind::kProcessModel; }
  std::string_view unit() const override { return "A"; }
  std::vector<Reading> Needs() const override { return {Reading::kWheels, Reading::kPower}; }
  bool by_wheel() const override { return true; }

  void Update(const MonitorReadings& now) override {
    if (!now.power.heard) return;
    for (std::size_t w = 0; w < wheels_.size(); ++w) {
      Wheel& wheel = wheels_[w];
      if (wheel.motor.gain == 0) continue;
      wheel.motor.voltage_v = now.power.battery_v;
      const double turns = now.wheel_rad[w] / now.dt_s;
      const double law_a =
          DriveTorque(wheel.motor, now.commanded_radps[w], turns) / wheel.motor.constant;
      const double chatters_a =
          wheel.motor.gain / wheel.motor.constant *
          wheel.chatters.Update(std::abs(turns - 2 * wheel.last + wheel.before_last), now.dt_s,
                                smooth_s_);
      wheel.before_last = std::exchange(wheel.last, turns);
      const double off_a =
          std::abs(wheel.off_a.Update(law_a - now.power.motor_a[w], now.dt_s, smooth_s_));
      const double asked_a = std::abs(wheel.law_a.Update(law_a, now.dt_s, smooth_s_));
      // The law is steep: an encoder that is wrong by its share is wrong by so much current.
      const double limit_a = wheel.limit_a + wheel.motor.gain / wheel.motor.constant *
                                                 encoder_share_ * std::abs(turns);
      if (chatters_a > kChatters * limit_a) continue;
      const bool bad = off_a > limit_a;
      // A motor of which nothing is asked gives nothing, sound or not; one that drives its own
      // friction lives.
      const double draws_a =
          std::abs(wheel.draws_a.Update(now.power.motor_a[w], now.dt_s, kDraws_s));
      alarm(w).Update(now.t_s, now.dt_s, bad,
                      !bad && (asked_a > 2 * wheel.limit_a || draws_a > alive_a_), off_a, limit_a);
    }
  }

 private:
  static constexpr double kChatters = 2;
  static constexpr double kDraws_s = 0.5;

  struct Wheel {
    VelocityDrive motor;
    double limit_a;
    LowPass off_a, law_a, draws_a, chatters;
    double last = 0, before_last = 0;  // rad/s
  };
  void VisitOwn(ParamVisitor& v) override {
    v("limit_share", limit_share_, Between(0.01, 10), "most error, by the motor's stall current");
    v("encoder_share", encoder_share_, Between(0, 1), "most error of an encoder, as a share");
    v("alive_a", alive_a_, NonNegative(), "a motor that draws this drives at least itself (A)");
    v("smooth_s", smooth_s_, NonNegative(), "time constant of the smoothing of the error (s)");
  }
  void StartOwn(const MonitorContext& context) override {
    wheels_.clear();
    for (const WheelSpec& wheel : context.robot.wheels) {
      const VelocityDrive& motor = wheel.motor;
      const double stall_a = motor.resistance_ohm > 0 ? motor.voltage_v / motor.resistance_ohm : 1;
      wheels_.push_back({motor, limit_share_ * stall_a, {}, {}, {}, {}, 0, 0});
    }
  }

  double limit_share_ = 0.2, encoder_share_ = 0.06, alive_a_ = 0.015, smooth_s_ = 0.1;
  std::vector<Wheel> wheels_;
};

}  // namespace

FP_DEFINE_PLUGIN(Monitor, MotorCurrent)

}  // namespace floorproof
