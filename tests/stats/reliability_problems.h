// SPDX-License-Identifier: Apache-2.0
// Problems of structural reliability, in standard normal coordinates: failure where g <= 0.
//
// R-S; the four branches of Waarts (2000); and of the black-box reliability challenge (Rozsas and
// Slobbe 2019) those of closed form. Their published probabilities are not used: some are off.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "stats/rare/rare_problem.h"

namespace floorproof::reliability {

using Point = Eigen::VectorXd;

struct Problem {
  std::string name;
  Eigen::Index dimensions = 2;
  std::function<double(const Point&)> g;
  double truth = 0;  // 0: by quadrature (two coordinates)
};

inline double Normal(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

// P(g <= 0) of two coordinates: exact along the second between the roots that a grid shows, the
// midpoint rule along the first.
inline double Quadrature(const std::function<double(const Point&)>& g) {
  constexpr double kFar = 8.5, kStep = 0.005, kGrid = 0.02;
  double sum = 0;
  Point u(2);
  const auto at = [&](double y) {
    u[1] = y;
    return g(u);
  };
  for (double x = -kFar + kStep / 2; x < kFar; x += kStep) {
    u[0] = x;
    double inside = 0;
    double from = -std::numeric_limits<double>::infinity();  // of a stretch that fails
    bool fails = at(-kFar) <= 0;
    for (double y = -kFar + kGrid; y < kFar; y += kGrid) {
      const double now = at(y);
      if ((now <= 0) != fails) {
        double low = y - kGrid, high = y;
        for (int i = 0; i < 40; ++i) {
          const double middle = (low + high) / 2;
          ((at(middle) <= 0) == fails ? low : high) = middle;
        }
        if (fails) inside += Normal(low) - Normal(from);
        from = low;
        fails = !fails;
      }
    }
    if (fails) inside += 1 - Normal(from);
    sum += inside * std::exp(-x * x / 2);
  }
  return sum * kStep / std::sqrt(2 * std::numbers::pi);
}

// P(|x y| >= c) of two standard normal numbers: their product has the density K0(|z|) / pi, and
// K0(z) is the integral of exp(-z cosh t), so that P = 2 / pi * integral of exp(-c cosh t) / cosh
// t.
inline double ProductBeyond(double c) {
  constexpr double kStep = 1e-4;
  double sum = 0;
  for (double t = kStep / 2; t < 20; t += kStep)
    sum += std::exp(-c * std::cosh(t)) / std::cosh(t) * kStep;
  return 2 / std::numbers::pi * sum;
}

inline std::vector<Problem> Problems() {
  const double root = std::numbers::sqrt2;
  std::vector<Problem> problems = {
      {"R-S", 2, [](const Point& u) { return (7 + u[0]) - (2 + u[1]); }, Normal(-5 / root)},
      {"four branches", 2,
       [=](const Point& u) {
         const double a = u[0] - u[1], b = (u[0] + u[1]) / root;
         return std::min({3 + 0.1 * a * a - b, 3 + 0.1 * a * a + b, a + 7 / root, -a + 7 / root});
       }},
      {"RP22", 2,
       [=](const Point& u) {
         return 2.5 - (u[0] + u[1]) / root + 0.1 * (u[0] - u[1]) * (u[0] - u[1]);
       }},
      {"RP25", 2,
       [](const Point& u) {
         return std::max(u[0] * u[0] - 8 * u[1] + 16, -16 * u[0] + u[1] + 32);
       }},
      {"RP28", 2,
       [](const Point& u) { return (78064 + 11710 * u[0]) * (0.0104 + 0.00156 * u[1]) - 146.14; }},
      {"RP31", 2, [](const Point& u) { return 2 - u[1] + 256 * std::pow(u[0], 4); }},
      {"RP53", 2,
       [](const Point& u) {
         const double x = 1.5 + u[0], y = 2.5 + u[1];
         return std::sin(5 * x / 2) + 2 - (x * x + 4) * (y - 1) / 20;
       }},
      {"RP57", 2,
       [](const Point& u) {
         const double x = u[0], y = u[1];
         return std::min(std::max(-x * x + y * y * y + 3, 2 - x - 8 * y),
                         (x + 3) * (x + 3) + (y + 3) * (y + 3) - 4);
       }},
      {"RP75", 2, [](const Point& u) { return 3 - u[0] * u[1]; }, ProductBeyond(3) / 2},
      {"RP89", 2,
       [](const Point& u) { return std::min(-u[0] * u[0] - u[1] + 8, -u[0] / 5 - u[1] + 6); }},
      {"RP107", 10, [](const Point& u) { return 5 * std::sqrt(10.0) - u.sum(); }, Normal(-5)},
      {"RP111", 2, [](const Point& u) { return 12.5 - std::abs(u[0] * u[1]); },
       ProductBeyond(12.5)}};
  return problems;
}

inline double Truth(const Problem& problem) {
  return problem.truth > 0 ? problem.truth : Quadrature(problem.g);
}

inline RareProblem AsTrials(const Problem& problem) {
  RareProblem trials{problem.dimensions, false, {}};
  trials.evaluate = [g = problem.g](std::span<const Trial> batch) {
    std::vector<TrialResult> results;
    for (const Trial& trial : batch) {
      const double value = g(trial.u);
      results.push_back({value <= 0, value, 0});
    }
    return results;
  };
  return trials;
}

}  // namespace floorproof::reliability
