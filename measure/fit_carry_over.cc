// SPDX-License-Identifier: Apache-2.0
#include "measure/fit_carry_over.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "base/round.h"

namespace floorproof {

CarryOver FitCarryOver(std::span<const Forecast> plans) {
  constexpr double kLeast = 1e-6;  // nothing is impossible
  constexpr double kOfIntercept = 0.5, kOfSlope = 0.5;
  constexpr double kLeastSlope = 0.1;  // what is predicted to fail more often is left so
  constexpr int kSteps = 50;
  const Eigen::Vector2d middle(0, 1);
  const Eigen::Matrix2d prior =
      Eigen::Vector2d(1 / (kOfIntercept * kOfIntercept), 1 / (kOfSlope * kOfSlope)).asDiagonal();
  CarryOver of;
  Eigen::Vector2d line = middle;
  for (int step = 0; step < kSteps; ++step) {
    Eigen::Vector2d gradient = prior * (middle - line);
    Eigen::Matrix2d curvature = prior;
    for (const Forecast& plan : plans) {
      if (plan.n == 0) continue;
      const double p = std::clamp(plan.p, kLeast, 1 - kLeast);
      const Eigen::Vector2d x(1, std::log(p) - std::log1p(-p));
      const double q = 1 / (1 + std::exp(-x.dot(line)));
      gradient += (static_cast<double>(plan.k) / plan.n - q) * x;
      curvature += q * (1 - q) * x * x.transpose();
    }
    const Eigen::Vector2d change = curvature.ldlt().solve(gradient);
    line += change;
    line[1] = std::max(line[1], kLeastSlope);
    if (change.norm() < 1e-9) break;
  }
  of.intercept = RoundedTo6(line[0]);
  of.slope = RoundedTo6(line[1]);
  for (const Forecast& plan : plans) {
    of.plans += plan.n > 0;
    of.drives += plan.n;
    of.failed += plan.k;
    of.expected += plan.n * plan.p;
  }
  of.expected = RoundedTo6(of.expected);
  return of;
}

}  // namespace floorproof
