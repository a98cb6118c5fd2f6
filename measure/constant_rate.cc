// SPDX-License-Identifier: Apache-2.0
#include "measure/constant_rate.h"

#include <cmath>

#include "base/round.h"
#include "base/streams.h"
#include "stats/binomial.h"
#include "stats/poisson.h"

namespace floorproof {
namespace {

// In the middle of equal shares of what may be, shuffled.
template <class EtaAt>
std::vector<double> MembersOf(std::string_view name, const EtaAt& eta_at) {
  std::vector<double> members;
  for (std::size_t r = 0; r < kRateMembers; ++r)
    members.push_back(eta_at((static_cast<double>(r) + 0.5) / kRateMembers));
  Stream random(0, 0, name);
  for (std::size_t r = kRateMembers - 1; r > 0; --r)
    std::swap(members[r], members[random.Below(r + 1)]);
  return members;
}

template <class EtaAt>
void Set(double eta, std::string_view name, const EtaAt& eta_at, LinearPredictor& of) {
  of.blocks.clear();
  of.coefficients = {RoundedTo6(eta)};
  of.members.clear();
  for (const double member : MembersOf(name, eta_at)) of.members.push_back({RoundedTo6(member)});
}

// Of Gamma(n) / exposure, by Garwood's intervals.
double GammaQuantile(int n, double exposure, double share) {
  const double confidence = std::abs(2 * share - 1);
  return share < 0.5 ? GarwoodInterval(n, exposure, confidence).lower
                     : GarwoodInterval(n - 1, exposure, confidence).upper;
}

}  // namespace

void SetConstantRate(double exposure, double rate, std::string_view name, LinearPredictor& of) {
  const auto quantile = [&](double share) {
    return EtaOf(GammaQuantile(of.events + 1, exposure, share));
  };
  Set(EtaOf(rate), name, quantile, of);
}

void SetShifted(const LinearPredictor& like, const std::function<double(double)>& expected,
                std::string_view name, LinearPredictor& of) {
  constexpr int kSeenBefore = 2, kHalvings = 40;
  constexpr double kMost = 16, kMostOfAll = 0.999;  // of all that could happen
  const double as_alike = expected(0);
  const auto shift_of = [&](double seen) {
    const double want =
        std::min(as_alike * seen / (as_alike + kSeenBefore), kMostOfAll * expected(kMost));
    double low = -kMost, high = kMost;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = (low + high) / 2;
      (expected(middle) < want ? low : high) = middle;
    }
    return (low + high) / 2;
  };
  of.blocks = like.blocks;
  of.coefficients = like.coefficients;
  of.members = like.members;
  const auto shift = [](double by, std::vector<double>& coefficients) {
    coefficients.front() = RoundedTo6(coefficients.front() + by);
  };
  shift(shift_of(of.events + kSeenBefore), of.coefficients);
  const std::vector<double> shifts = MembersOf(name, [&](double share) {
    return shift_of(GammaQuantile(of.events + kSeenBefore, 1, share));
  });
  for (std::size_t r = 0; r < kRateMembers; ++r) shift(shifts[r], of.members[r]);
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
