// SPDX-License-Identifier: Apache-2.0
// Encoders on the driven wheels. They count the wheel's turn against the chassis: a wheel that
// slips turns on, and the way it says was never driven.
//
// The count is quantised to whole ticks and keeps its remainder, as a counter does. `bias` is a
// wheel that is smaller than it is thought to be; `noise` is what is lost or gained from period to
// period.
#include <algorithm>
#include <cmath>
#include <optional>

#include "env/sensors/sensor.h"

namespace floorproof {
namespace {

class Encoders final : public Sensor {
 public:
  Reading Fills() const override { return Reading::kWheels; }
  bool draws() const override { return noise_ > 0; }
  void Visit(ParamVisitor& v) override {
    v("ticks", ticks_, Between(1, 1e7), "a wheel's turn is counted in");
    v("noise", noise_, Between(0, 1), "standard deviation of a period's turn, as a share of it");
    v("bias", bias_, Between(-0.5, 0.5), "share by which every turn is told too large");
  }

  void Start(const SensorContext& context, const mjData* data, const Truth& truth,
             const Stream& noise, Observation& out) override {
    const mjModel* m = context.scene.model.get();
    const std::vector<WheelSpec>& wheels = context.robot.wheels;
    stream_ = noise;
    joints_.clear();
    for (const WheelSpec& wheel : wheels) {
      const int joint = mj_name2id(m, mjOBJ_JOINT, wheel.name.c_str());
      if (joint < 0) throw InternalError("the scene has no joint " + wheel.name);
      joints_.push_back(m->jnt_qposadr[joint]);
    }
    last_rad_.clear();
    for (const int adr : joints_) last_rad_.push_back(data->qpos[adr]);
    remainder_rad_.assign(wheels.size(), 0);
    out.wheel_rad.assign(wheels.size(), 0);
    out.hinges = truth.hinges;
  }

  void Sense(mjData* data, const Truth& truth, Observation& out) override {
    const double tick_rad = 2 * kPi / ticks_;
    told_ = out.hinges;
    out.hinges = truth.hinges;
    for (int h = 0; h < out.hinges.n; ++h) {
      double& rad = out.hinges.rad[static_cast<std::size_t>(h)];
      rad = tick_rad * std::round(rad / tick_rad);
    }
    out.hinges.steer_rad = tick_rad * std::round(out.hinges.steer_rad / tick_rad);
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      const double now_rad = data->qpos[joints_[i]];
      double turned_rad = (now_rad - last_rad_[i]) * (1 + bias_);
      turned_rad *= 1 + noise_ * stream_->Normal();
      last_rad_[i] = now_rad;
      remainder_rad_[i] += turned_rad;
      out.wheel_rad[i] = tick_rad * std::floor(remainder_rad_[i] / tick_rad + 0.5);
      remainder_rad_[i] -= out.wheel_rad[i];
    }
  }

  // The wheels seem to stand, hinges and fork too, where they were heard of last.
  void Silence(Observation& out) const override {
    std::ranges::fill(out.wheel_rad, 0.0);
    out.hinges = told_;
    out.hinges.radps = {};
    out.hinges.steer_radps = 0;
  }

 private:
  int ticks_ = 4096;
  double noise_ = 0, bias_ = 0;
  std::optional<Stream> stream_;
  std::vector<int> joints_;  // addresses of the wheels' angles
  std::vector<double> last_rad_, remainder_rad_;
  HingeState told_;  // in the period before
};

}  // namespace

FP_DEFINE_PLUGIN(Sensor, Encoders)

}  // namespace floorproof
