// SPDX-License-Identifier: Apache-2.0
// Wheels that should draw alike and do not: they work against each other, as where a wheel's
// rollers are blocked, or a load lies on few of them. Which of them it is, the currents do not say.
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
    int turning = 0, odd = 0;
    for (const auto& share : shares) {
      turning += share ? 1 : 0;
      odd += share && !(*share > agree_ && *share < 1 / agree_) ? 1 : 0;
    }
    if (turning == 0) return;
    const bool bad = odd > most_odd_;
    alarm().Update(now.t_s, now.dt_s, bad, !bad, odd, most_odd_);
  }

 private:
  void VisitOwn(ParamVisitor& v) override {
    v("agree", agree_, Between(0.01, 0.99),
      "wheels draw from this share of the median to its inverse");
    v("most_odd", most_odd_, Between(0, 100), "wheels that may disagree");
    params_.Visit(v);
  }
  void StartOwn(const MonitorContext& context) override { shares_.Start(params_, context.robot); }

  double agree_ = 0.45;
  int most_odd_ = 2;
  WheelShareParams params_;
  WheelShares shares_;
};

}  // namespace

FP_DEFINE_PLUGIN(Monitor, WheelSpread)

}  // namespace floorproof
