// SPDX-License-Identifier: Apache-2.0
// An IMU's signal as it should be: it is heard, and its noise lives.
#include "controllers/monitors/monitor.h"

namespace floorproof {
namespace {

class ImuSignal final : public Monitor {
 public:
  ImuSignal() : Monitor({.hold_s = 0.2, .clear_s = 0.5, .permanent_s = 120}) {}
  MonitorKind kind() const override { return MonitorKind::kSignalModel; }
  std::string_view unit() const override { return "s"; }
  std::vector<Reading> Needs() const override { return {Reading::kImu}; }

  void Update(const MonitorReadings& now) override {
    const bool frozen = now.gyro_radps == last_radps_ && now.accel_mps2 == last_mps2_;
    last_radps_ = now.gyro_radps;
    last_mps2_ = now.accel_mps2;
    silent_s_ = now.has_imu && !frozen ? 0 : silent_s_ + now.dt_s;
    alarm().Update(now.t_s, now.dt_s, silent_s_ > 0, silent_s_ == 0, silent_s_, 0);
  }

 private:
  void VisitOwn(ParamVisitor&) override {}
  void StartOwn(const MonitorContext&) override {
    last_radps_ = last_mps2_ = Vec3::Zero();
    silent_s_ = 0;
  }

  Vec3 last_radps_ = Vec3::Zero(), last_mps2_ = Vec3::Zero();
  double silent_s_ = 0;
};

}  // namespace

FP_DEFINE_PLUGIN(Monitor, ImuSignal)

}  // namespace floorproof
