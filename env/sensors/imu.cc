// SPDX-License-Identifier: Apache-2.0
// An IMU: rates of turn and specific force in body axes. Each axis has white noise, drawn anew
// every control period, and a bias, drawn once an episode. The acceleration is the mean over the
// period since the last, as a device averages what it samples faster; at rest it is g, upwards.
#include <optional>

#include "env/sensors/body_frame.h"
#include "env/sensors/sensor.h"

namespace floorproof {
namespace {

class Imu final : public Sensor {
 public:
  Reading Fills() const override { return Reading::kImu; }
  bool draws() const override {
    return gyro_noise_ > 0 || gyro_bias_ > 0 || accel_noise_ > 0 || accel_bias_ > 0;
  }
  void Visit(ParamVisitor& v) override {
    v("gyro_noise_radps", gyro_noise_, NonNegative(), "standard deviation of each reading (rad/s)");
    v("gyro_bias_radps", gyro_bias_, NonNegative(),
      "standard deviation of the bias, drawn once an episode (rad/s)");
    v("accel_noise_mps2", accel_noise_, NonNegative(),
      "standard deviation of each reading (m/s^2)");
    v("accel_bias_mps2", accel_bias_, NonNegative(),
      "standard deviation of the bias, drawn once an episode (m/s^2)");
  }

  void Start(const SensorContext& context, const mjData*, const Truth& truth, const Stream& noise,
             Observation& out) override {
    model_ = context.scene.model.get();
    base_ = context.scene.base_body;
    control_s_ = context.control_s;
    stream_ = noise;
    for (int i = 0; i < 3; ++i) gyro_offset_[i] = gyro_bias_ * stream_->Normal();
    for (int i = 0; i < 3; ++i) accel_offset_[i] = accel_bias_ * stream_->Normal();
    last_v_W_ = truth.v_WB_W;
    out.has_imu = true;
  }

  void Sense(mjData* data, const Truth& truth, Observation& out) override {
    mjtNum V[6];  // turn, then travel, in the base's axes
    mj_objectVelocity(model_, data, mjOBJ_XBODY, base_, V, 1);
    const Rotation R_WB = RotationOf(data, base_);
    const Vec3 g_W(model_->opt.gravity[0], model_->opt.gravity[1], model_->opt.gravity[2]);
    const Vec3 force_W = (truth.v_WB_W - last_v_W_) / control_s_ - g_W;
    last_v_W_ = truth.v_WB_W;
    out.has_imu = true;
    out.gyro_radps = Vec3(V) + gyro_offset_;
    out.accel_mps2 = R_WB.transpose() * force_W + accel_offset_;
    for (int i = 0; i < 3; ++i) {  // always as many draws: no key's value changes another's noise
      out.gyro_radps[i] += gyro_noise_ * stream_->Normal();
      out.accel_mps2[i] += accel_noise_ * stream_->Normal();
    }
  }

  // A device without power: neither rates nor force.
  void Silence(Observation& out) const override {
    out.has_imu = false;
    out.gyro_radps = out.accel_mps2 = Vec3::Zero();
  }

 private:
  // A small MEMS device: 0.1 deg/s of noise, 0.05 deg/s of bias left after calibration at rest.
  double gyro_noise_ = 0.002, gyro_bias_ = 0.001, accel_noise_ = 0.05, accel_bias_ = 0.02;
  const mjModel* model_ = nullptr;
  int base_ = -1;
  double control_s_ = 0.02;
  std::optional<Stream> stream_;
  Vec3 gyro_offset_ = Vec3::Zero(), accel_offset_ = Vec3::Zero(), last_v_W_ = Vec3::Zero();
};

}  // namespace

FP_DEFINE_PLUGIN(Sensor, Imu)

}  // namespace floorproof
