// SPDX-License-Identifier: Apache-2.0
// A battery whose voltage, the mean over a while, has fallen below the highest such mean by more
// than load and charge explain.
#include <algorithm>

#include "controllers/monitors/monitor.h"

namespace floorproof {
namespace {

class BatteryTrend final : public Monitor {
 public:
  BatteryTrend() : Monitor({.hold_s = 0.5}) {}
  MonitorKind kind() const override { return MonitorKind::kTrend; }
  std::string_view unit() const override { return "V"; }
  std::vector<Reading> Needs() const override { return {Reading::kPower}; }

  void Update(const MonitorReadings& now) override {
    if (!now.power.heard) return;
    const double mean_v = mean_v_.Update(now.power.battery_v, now.dt_s, mean_s_);
    best_v_ = std::max(best_v_, mean_v);
    const double limit_v = (1 - fall_) * best_v_;
    const bool bad = mean_v < limit_v;
    alarm().Update(now.t_s, now.dt_s, bad, !bad, mean_v, limit_v);
  }

 private:
  void VisitOwn(ParamVisitor& v) override {
    v("fall", fall_, Between(0.001, 1), "most that it may fall, by its best");
    v("mean_s", mean_s_, Positive(), "time constant of the mean (s)");
  }
  void StartOwn(const MonitorContext&) override {
    mean_v_.Reset();
    best_v_ = 0;
  }

  double fall_ = 0.08, mean_s_ = 1;
  LowPass mean_v_;
  double best_v_ = 0;
};

}  // namespace

FP_DEFINE_PLUGIN(Monitor, BatteryTrend)

}  // namespace floorproof
