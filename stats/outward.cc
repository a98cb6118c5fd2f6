// SPDX-License-Identifier: Apache-2.0
#include "stats/outward.h"

#include <cmath>

namespace floorproof {
namespace {

constexpr double kSlack = 1e-9;  // of the last digit: what has three digits stays

double RoundedUp(double value) {
  if (value == 0 || !std::isfinite(value)) return value;
  const double unit = std::pow(10, std::floor(std::log10(std::abs(value))) - 2);
  return std::ceil(value / unit - kSlack) * unit;
}

}  // namespace

Interval RoundedOutward(const Interval& exact) {
  return {-RoundedUp(-exact.lower), RoundedUp(exact.upper)};
}

}  // namespace floorproof
