// SPDX-License-Identifier: Apache-2.0
#include "measure/constant_rate.h"

#include <cmath>

#include "base/round.h"
#include "base/streams.h"
#include "stats/binomial.h"
#include "stats/poisson.h"

namespace floorproof {
namespace {

double LogOdds(double p) { return std::log(p) - std::log1p(-p); }

// The members stand in the middle of equal shares of what may be, shuffled.
template <class EtaAt>
void Set(double eta, std::string_view name, const EtaAt& eta_at, LinearPredictor& of) {
  of.blocks.clear();
  of.coefficients = {RoundedTo6(eta)};
  of.members.clear();
  for (std::size_t r = 0; r < kRateMembers; ++r)
    of.members.push_back({RoundedTo6(eta_at((static_cast<double>(r) + 0.5) / kRateMembers))});
  Stream random(0, 0, name);
  for (std::size_t r = kRateMembers - 1; r > 0; --r)
    std::swap(of.members[r], of.members[random.Below(r + 1)]);
}

}  // namespace

void SetConstantRate(double exposure, double rate, std::string_view name, LinearPredictor& of) {
  const auto quantile = [&](double share) {  // of Gamma, by Garwood's intervals
    const double confidence = std::abs(2 * share - 1);
    return EtaOf(share < 0.5 ? GarwoodInterval(of.events + 1, exposure, confidence).lower
                             : GarwoodInterval(of.events, exposure, confidence).upper);
  };
  Set(EtaOf(rate), name, quantile, of);
}

void SetConstantShare(int n, std::string_view name, LinearPredictor& of) {
  const auto quantile = [&](double share) {  // of Beta, by Clopper and Pearson's bounds
    return LogOdds(ClopperPearsonUpper(of.events, n + 1, share));
  };
  Set(LogOdds((of.events + 0.5) / (n + 1)), name, quantile, of);
}

void SetShare(double share, LinearPredictor& of) {
  of.blocks.clear();
  of.coefficients = {RoundedTo6(LogOdds(share))};
  of.members.assign(kRateMembers, of.coefficients);
}

}  // namespace floorproof
