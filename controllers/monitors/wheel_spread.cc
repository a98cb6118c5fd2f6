// SPDX-License-Identifier: Apache-2.0
// Wheels that should draw alike and do not: they work against each other, as where a wheel's
// rollers are blocked, or a load lies on few of them. Which of them it is, the currents do not say.
#include <algorithm>

#include "controllers/monitors/wheel_shares.h"

namespace floorproof {
namespace {

class WheelSpread final : public Monitor {
 public:
  WheelSpread() : Monitor({.hold_s = 0.5}) {}
  MonitorKind kind() const override { return MonitorKind::kMultivariate; }
  std::vector<Reading> Needs() const override { return {Reading::kPower}; }

  void Update(const MonitorReadings& now) override {
    const auto shares = shares_.Update(now);
    if (std::ranges::none_of(shares, &WheelShare::has_value)) return;
    const int odd = shares_.Odd(shares);
    const bool bad = odd > most_odd_;
    alarm().Update(now.t_s, now.dt_s, bad, !bad, odd, most_odd_);
  }

 private:
  void VisitOwn(ParamVisitor& v) override {
    v("most_odd", most_odd_, Between(0, 100), "wheels that may disagree");
    params_.Visit(v);
  }
  void StartOwn(const MonitorContext& context) override { shares_.Start(params_, context.robot); }

  int most_odd_ = 2;
  WheelShareParams params_;
  WheelShares shares_;
};

}  // namespace

FP_DEFINE_PLUGIN(Monitor, WheelSpread)

}  // namespace floorproof
