// SPDX-License-Identifier: Apache-2.0
// What the motors' drivers and the battery measure. A motor's current is its torque by its
// constant, i = T / K, the mean over the period since the last; both readings have white noise.
#include <algorithm>
#include <optional>

#include "env/sensors/sensor.h"

namespace floorproof {
namespace {

class Power final : public Sensor {
 public:
  Reading Fills() const override { return Reading::kPower; }
  bool draws() const override { return current_noise_a_ > 0 || voltage_noise_v_ > 0; }
  void Visit(ParamVisitor& v) override {
    v("current_noise_a", current_noise_a_, NonNegative(), "standard deviation of each current (A)");
    v("voltage_noise_v", voltage_noise_v_, NonNegative(), "standard deviation of the voltage (V)");
  }

  void Start(const SensorContext& context, const mjData*, const Truth& truth, const Stream& noise,
             Observation& out) override {
    motor_nm_ = context.motor_nm;
    constant_.clear();
    const mjModel* m = context.scene.model.get();
    for (const WheelSpec& wheel : context.robot.wheels)
      constant_.push_back(
          m->actuator_gainprm[mjNGAIN * mj_name2id(m, mjOBJ_ACTUATOR, wheel.name.c_str()) + 1]);
    if (motor_nm_.size() < constant_.size())
      throw InternalError("nothing tells the motors' torques");
    sum_nm_.assign(constant_.size(), 0);
    steps_ = 0;
    stream_ = noise;
    out.power = {true, std::vector<double>(constant_.size()), truth.battery_v};
  }

  void OnStep(const Truth&) override {
    for (std::size_t w = 0; w < sum_nm_.size(); ++w) sum_nm_[w] += motor_nm_[w];
    ++steps_;
  }

  void Sense(mjData*, const Truth& truth, Observation& out) override {
    out.power.heard = true;
    out.power.battery_v = truth.battery_v + voltage_noise_v_ * stream_->Normal();
    for (std::size_t w = 0; w < sum_nm_.size(); ++w) {
      const double mean_nm = steps_ > 0 ? sum_nm_[w] / steps_ : 0;
      out.power.motor_a[w] = mean_nm / constant_[w] + current_noise_a_ * stream_->Normal();
      sum_nm_[w] = 0;
    }
    steps_ = 0;
  }

  void Silence(Observation& out) const override {
    out.power.heard = false;
    std::ranges::fill(out.power.motor_a, 0.0);
    out.power.battery_v = 0;
  }

 private:
  // A shunt of the drivers' price class, and a 10 bit converter on the battery.
  double current_noise_a_ = 0.02, voltage_noise_v_ = 0.02;
  std::span<const double> motor_nm_;
  std::vector<double> constant_, sum_nm_;  // by wheel
  int steps_ = 0;
  std::optional<Stream> stream_;
};

}  // namespace

FP_DEFINE_PLUGIN(Sensor, Power)

}  // namespace floorproof
