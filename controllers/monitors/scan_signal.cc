// SPDX-License-Identifier: Apache-2.0
// A lidar's signal as it should be: a turn every so often, and some of its beams come back.
#include <cmath>

#include "controllers/monitors/monitor.h"

namespace floorproof {
namespace {

class ScanSignal final : public Monitor {
 public:
  ScanSignal() : Monitor({.hold_s = 0.3, .clear_s = 0.5, .permanent_s = 120}) {}
  MonitorKind kind() const override { return MonitorKind::kSignalModel; }
  std::vector<Reading> Needs() const override { return {Reading::kScan}; }

  void Update(const MonitorReadings& now) override {
    const LidarScan& scan = now.scan;
    if (scan.fresh) {
      since_s_ = 0;
      int back = 0;
      for (const double range_m : scan.range_m) back += std::isfinite(range_m) ? 1 : 0;
      share_ = scan.range_m.empty() ? 0 : back / static_cast<double>(scan.range_m.size());
    }
    since_s_ += now.dt_s;
    const bool late = since_s_ > late_s_, empty = share_ < least_share_;
    alarm().Update(now.t_s, now.dt_s, late || empty, !late && !empty, late ? since_s_ : share_,
                   late ? late_s_ : least_share_);
  }

 private:
  void VisitOwn(ParamVisitor& v) override {
    v("late_s", late_s_, Positive(), "most time between two turns (s)");
    v("least_share", least_share_, Between(0, 1), "least share of beams that come back");
  }
  void StartOwn(const MonitorContext&) override {
    since_s_ = 0;
    share_ = 1;
  }

  double late_s_ = 0.3, least_share_ = 0.02;
  double since_s_ = 0, share_ = 1;
};

}  // namespace

FP_DEFINE_PLUGIN(Monitor, ScanSignal)

}  // namespace floorproof
