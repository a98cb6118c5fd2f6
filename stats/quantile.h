// SPDX-License-Identifier: Apache-2.0
// Quantiles of a sample.
#pragma once

#include <span>
#include <vector>

namespace floorproof {

// The value below which `share` (0 to 1) of the values lie, between neighbours in proportion
// (Hyndman & Fan 1996, type 7). `ascending`: in that order, at least one.
double Quantile(std::span<const double> ascending, double share);

struct Quartiles {
  double lower = 0, median = 0, upper = 0;
};
// In any order, at least one.
Quartiles QuartilesOf(std::vector<double> values);

}  // namespace floorproof
