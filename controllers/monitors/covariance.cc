// SPDX-License-Identifier: Apache-2.0
// An estimate that is unsure of its place by its own account. It may be so at the start, until it
// has once been sure.
#include "controllers/monitors/monitor.h"

namespace floorproof {
namespace {

class CovarianceLimit final : public Monitor {
 public:
  CovarianceLimit() : Monitor({.hold_s = 0.5}) {}
  bool by_estimate() const override { return true; }
  MonitorKind kind() const override { return MonitorKind::kLimit; }
  std::string_view unit() const override { return "m"; }
  std::vector<Reading> Needs() const override { return {}; }

  void Update(const MonitorReadings& now) override {
    const double std_m = now.estimate.position_std_m;
    sure_ |= std_m < limit_m_;
    const bool bad = sure_ && std_m > limit_m_;
    alarm().Update(now.t_s, now.dt_s, bad, sure_ && !bad, std_m, limit_m_);
  }

 private:
  void VisitOwn(ParamVisitor& v) override {
    v("limit_m", limit_m_, Positive(), "most standard deviation of its place (m)");
  }
  void StartOwn(const MonitorContext&) override { sure_ = false; }

  double limit_m_ = 0.3;
  bool sure_ = false;
};

}  // namespace

FP_DEFINE_PLUGIN(Monitor, CovarianceLimit)

}  // namespace floorproof
