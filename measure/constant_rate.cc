// SPDX-License-Identifier: Apache-2.0
#include "measure/constant_rate.h"

#include <cmath>

#include "base/round.h"
#include "base/streams.h"
#include "stats/poisson.h"

namespace floorproof {

void SetConstantRate(double exposure, double rate, std::string_view name, ModeRates& mode) {
  // Gamma's quantiles in the middle of equal shares, by Garwood's intervals, shuffled.
  std::vector<double> rates;
  for (std::size_t r = 0; r < kRateMembers; ++r) {
    const double share = (static_cast<double>(r) + 0.5) / kRateMembers,
                 confidence = std::abs(2 * share - 1);
    rates.push_back(share < 0.5 ? GarwoodInterval(mode.events + 1, exposure, confidence).lower
                                : GarwoodInterval(mode.events, exposure, confidence).upper);
  }
  Stream random(0, 0, name);
  for (std::size_t r = kRateMembers - 1; r > 0; --r)
    std::swap(rates[r], rates[random.Below(r + 1)]);
  mode.blocks.clear();
  mode.coefficients = {RoundedTo6(EtaOf(rate))};
  mode.members.clear();
  for (const double drawn : rates) mode.members.push_back({RoundedTo6(EtaOf(drawn))});
}

}  // namespace floorproof
