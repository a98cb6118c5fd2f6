// SPDX-License-Identifier: Apache-2.0
#include "measure/fit_carry_over.h"

#include <algorithm>
#include <vector>

#include "base/round.h"

namespace floorproof {

CarryOver FitCarryOver(std::span<const Forecast> plans) {
  constexpr double kLeast = 1e-6;  // nothing is impossible
  constexpr double kDeviation = 0.5;
  constexpr double kLeastSlope = 0.1;  // what is predicted to fail more often is left so
  CarryOver of;
  std::vector<Forecast> possible(plans.begin(), plans.end());
  for (Forecast& plan : possible) {
    of.plans += plan.n > 0;
    of.drives += plan.n;
    of.failed += plan.k;
    of.expected += plan.n * plan.p;
    plan.p = std::clamp(plan.p, kLeast, 1 - kLeast);
  }
  const LogisticLine line = PenalisedCalibrationLine(possible, kDeviation);
  of.intercept = RoundedTo6(line.intercept);
  of.slope = RoundedTo6(std::max(line.slope, kLeastSlope));
  of.expected = RoundedTo6(of.expected);
  return of;
}

}  // namespace floorproof
