// SPDX-License-Identifier: Apache-2.0
// A wheel among its peers: one that draws next to nothing while the others draw alike has a dead
// motor. Where the others do not agree either, nobody can say who is the odd one (wheel_spread.cc).
#include "controllers/monitors/wheel_shares.h"

namespace floorproof {
namespace {

class WheelPeers final : public Monitor {
 public:
  WheelPeers() : Monitor({.hold_s = 0.5}) {}
  MonitorKind kind() const override { return MonitorKind::kMultivariate; }
  std::vector<Reading> Needs() const override { return {Reading::kPower}; }
  bool by_wheel() const override { return true; }

  void Update(const MonitorReadings& now) override {
    const auto shares = shares_.Update(now);
    const int odd = shares_.Odd(shares);
    for (std::size_t w = 0; w < shares.size(); ++w) {
      if (!shares[w]) continue;
      const double share = *shares[w];
      const bool bad = odd <= most_odd_ && share < least_share_;
      alarm(w).Update(now.t_s, now.dt_s, bad, shares_.Agrees(share), share, least_share_);
    }
  }

 private:
  void VisitOwn(ParamVisitor& v) override {
    v("least_share", least_share_, Between(-1, 1), "a dead motor draws less of the median");
    v("most_odd", most_odd_, Between(1, 100), "wheels that may disagree at once");
    params_.Visit(v);
  }
  void StartOwn(const MonitorContext& context) override { shares_.Start(params_, context.robot); }

  double least_share_ = 0.3;
  int most_odd_ = 2;
  WheelShareParams params_;
  WheelShares shares_;
};

}  // namespace

FP_DEFINE_PLUGIN(Monitor, WheelPeers)

}  // namespace floorproof
