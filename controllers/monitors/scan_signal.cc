// SPDX-License-Identifier: Apache-2.0
// A lidar's signal as it should be: a turn every so often, and some of its beams come back.
#include <algorithm>
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
    since_s_ += now.dt_s;
    if (scan.fresh) {
      if (scans_++ > 0) gap_s_ = std::max(gap_s_, std::min(since_s_, kSlowest_s));
      since_s_ = 0;
      Count(scan);
    }
    const double late_s = late_gaps_ * (scans_ > 1 ? gap_s_ : kSlowest_s);
    const bool late = since_s_ > late_s;
    alarm().Update(now.t_s, now.dt_s, late || empty_, !late && !empty_, late ? since_s_ : share_,
                   late ? late_s : least_share_);
  }

 private:
  static constexpr double kSlowest_s = 2;  // a turn of the slowest lidar
  static constexpr double kMany = 0.3;     // share of beams

  // In the open no beam comes back; that many stop to come back at once is no open floor.
  void Count(const LidarScan& scan) {
    int back = 0;
    for (const double range_m : scan.range_m) back += std::isfinite(range_m) ? 1 : 0;
    const double before = share_;
    share_ = scan.range_m.empty() ? 0 : back / static_cast<double>(scan.range_m.size());
    empty_ = share_ < least_share_ && (empty_ || before > kMany);
  }
  void VisitOwn(ParamVisitor& v) override {
    v("late_gaps", late_gaps_, Between(1, 100),
      "a turn that is late by so many usual gaps is missing");
    v("least_share", least_share_, Between(0, 1),
      "least share of beams that come back, where a turn before many did");
  }
  void StartOwn(const MonitorContext&) override {
    since_s_ = gap_s_ = share_ = 0;
    scans_ = 0;
    empty_ = false;
  }

  double late_gaps_ = 3, least_share_ = 0.02;
  double since_s_ = 0, gap_s_ = 0, share_ = 0;
  int scans_ = 0;
  bool empty_ = false;
};

}  // namespace

FP_DEFINE_PLUGIN(Monitor, ScanSignal)

}  // namespace floorproof
