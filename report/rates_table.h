// SPDX-License-Identifier: Apache-2.0
// A table of rates with their intervals drawn beside them on one axis.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "run/campaign/campaign_summary.h"

namespace floorproof {

struct RatesPlot {
  double reach = 1;               // the axis' right end
  std::optional<double> limit{};  // dashed
  std::string limit_of{};         // the rate that has it; empty: every one
  std::string counted = "Episodes";
};

// The least 1, 2 or 5 times a power of ten that holds it; 1 at most.
double AxisEnd(double most);

// `names`: what stands in the first column, a row each; `total`: the first row is all of it.
std::string RatesTable(const RatesPlot& plot, const std::string& heading,
                       const std::vector<std::string>& names, const std::vector<FailureRate>& rates,
                       bool total = false);

}  // namespace floorproof
