// SPDX-License-Identifier: Apache-2.0
// Rates by formula: whose modes have the same shares everywhere, and whose posterior is a point.
#pragma once

#include <cmath>

#include "planners/risk/rate_model.h"

namespace floorproof::testing {

inline LinearPredictor Point(std::vector<double> coefficients) {
  LinearPredictor of;
  of.members.assign(kRateMembers, coefficients);
  of.coefficients = std::move(coefficients);
  return of;
}

// Modes' shares are as these numbers, one of them above 0.
inline void PlantShares(const ModeNumbers& shares, KindRates& kind) {
  double left = Total(shares);
  for (std::size_t m = 0; m < kind.splits.size(); ++m) {
    constexpr double kNone = -100, kAll = 100;  // eta
    const double others = left - shares[m];
    const double eta = shares[m] <= 0 ? kNone : others <= 0 ? kAll : std::log(shares[m] / others);
    kind.splits[m] = {FailureMode(m), Point({eta})};
    left = others;
  }
}

// These rates at any meeting.
inline void PlantRates(const ModeNumbers& rates, KindRates& kind) {
  const double total = Total(rates);
  kind.any = Point({total > 0 ? EtaOf(total) : -100});
  PlantShares(total > 0 ? rates : ModeNumbers{1}, kind);
}

}  // namespace floorproof::testing
