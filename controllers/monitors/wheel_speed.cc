// SPDX-License-Identifier: Apache-2.0
// A wheel that does not turn as it is told: its encoder's speed beside the commanded one, as late
// as a sound wheel is.
#include <cmath>

#include "controllers/monitors/monitor.h"

namespace floorproof {
namespace {

class WheelSpeed final : public Monitor {
 public:
  WheelSpeed() : Monitor({.hold_s = 0.2}) {}
  MonitorKind kind() const override { return MonitorKind::kLimit; }
  std::string_view unit() const override { return "rad/s"; }
  std::vector<Reading> Needs() const override { return {Reading::kWheels}; }
  bool by_wheel() const override { return true; }

  void Update(const MonitorReadings& now) override {
    for (std::size_t w = 0; w < wheels_.size(); ++w) {
      Wheel& wheel = wheels_[w];
      const double told = wheel.told.Update(now.commanded_radps[w], now.dt_s, lag_s_);
      const double turns = wheel.turns.Update(now.wheel_rad[w] / now.dt_s, now.dt_s, smooth_s_);
      const double off = std::abs(told - turns);
      const bool bad = off > wheel.limit_radps;
      // One that is told to stand says nothing about its motor.
      alarm(w).Update(now.t_s, now.dt_s, bad, !bad && std::abs(told) > wheel.limit_radps, off,
                      wheel.limit_radps);
    }
  }

 private:
  struct Wheel {
    double limit_radps;
    LowPass told, turns;
  };
  void VisitOwn(ParamVisitor& v) override {
    v("limit_share", limit_share_, Between(0.01, 10), "most error, by the speed at cruise");
    v("lag_s", lag_s_, NonNegative(), "a sound wheel follows its command so late (s)");
    v("smooth_s", smooth_s_, NonNegative(), "time constant of the encoder's smoothing (s)");
  }
  void StartOwn(const MonitorContext& context) override {
    wheels_.clear();
    for (const WheelSpec& wheel : context.robot.wheels)
      wheels_.push_back({limit_share_ * context.robot.cruise_mps / wheel.radius_m, {}, {}});
  }

  double limit_share_ = 0.3, lag_s_ = 0.05, smooth_s_ = 0.05;
  std::vector<Wheel> wheels_;
};

}  // namespace

FP_DEFINE_PLUGIN(Monitor, WheelSpeed)

}  // namespace floorproof
