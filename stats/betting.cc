// SPDX-License-Identifier: Apache-2.0
#include "stats/betting.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "base/params.h"
#include "stats/checks.h"

namespace floorproof {
namespace {

// Shares of their stake that bettors of the mixture bet, each with as much to begin with. Cautious
// ones gain where the numbers vary a lot, bold ones where they hardly do.
constexpr std::array<double, 9> kShares = {0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.35, 0.5, 0.7};

// What the stake of the mixture has become, as a logarithm, if the mean was m.
double LogStake(std::span<const double> numbers, double m) {
  std::array<double, kShares.size()> logs{};
  for (std::size_t i = 0; i < kShares.size(); ++i)
    for (const double x : numbers) logs[i] += std::log1p(kShares[i] * (x / m - 1));
  const double most = *std::ranges::max_element(logs);
  double sum = 0;
  for (const double log : logs) sum += std::exp(log - most);
  return most + std::log(sum / kShares.size());
}

}  // namespace

double BettingLowerBound(std::span<const double> numbers, double confidence) {
  CheckConfidence(confidence);
  double sum = 0;
  for (const double x : numbers) {
    if (!(x >= 0 && std::isfinite(x)))
      throw InputError({}, "numbers", FormatDouble(x), "must be finite and >= 0");
    sum += x;
  }
  if (sum == 0) return 0;
  const double needed = -std::log(1 - confidence);
  // The stake falls as m grows; at the numbers' own mean no bettor has gained.
  double high = std::log(sum / static_cast<double>(numbers.size())), low = high - 50;
  if (LogStake(numbers, std::exp(low)) < needed) return 0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (LogStake(numbers, std::exp(middle)) >= needed ? low : high) = middle;
  }
  return std::exp(low);
}

}  // namespace floorproof
