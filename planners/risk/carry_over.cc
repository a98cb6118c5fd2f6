// SPDX-License-Identifier: Apache-2.0
#include "planners/risk/carry_over.h"

#include <cmath>

namespace floorproof {

double LogOdds(double p) { return std::log(p) - std::log1p(-p); }

double CarryOver::Of(double p) const {
  if (plans == 0 || p <= 0 || p >= 1) return p;
  return 1 / (1 + std::exp(-intercept - slope * LogOdds(p)));
}

}  // namespace floorproof
