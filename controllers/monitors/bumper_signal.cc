// SPDX-License-Identifier: Apache-2.0
// A bumper that stays pressed: a touch ends when the robot goes back; a bumper that does not is
// stuck, or the robot is.
#include "controllers/monitors/monitor.h"

namespace floorproof {
namespace {

class BumperSignal final : public Monitor {
 public:
  BumperSignal() : Monitor({.hold_s = 3}) {}
  MonitorKind kind() const override { return MonitorKind::kSignalModel; }
  std::string_view unit() const override { return "s"; }
  std::vector<Reading> Needs() const override { return {Reading::kBump}; }

  void Update(const MonitorReadings& now) override {
    const bool pressed = now.bump.pressed;
    pressed_s_ = pressed ? pressed_s_ + now.dt_s : 0;
    alarm().Update(now.t_s, now.dt_s, pressed, !pressed, pressed_s_, 0);
  }

 private:
  void VisitOwn(ParamVisitor&) override {}
  void StartOwn(const MonitorContext&) override { pressed_s_ = 0; }

  double pressed_s_ = 0;
};

}  // namespace

FP_DEFINE_PLUGIN(Monitor, BumperSignal)

}  // namespace floorproof
