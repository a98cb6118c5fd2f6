// SPDX-License-Identifier: Apache-2.0
#include "stats/rare/likeliest_failures.h"

#include <cmath>

#include "stats/rare/subset_pilot.h"

namespace floorproof {

std::vector<Trial> Likeliest(const RareProblem& problem, std::vector<Trial> failures,
                             Stream& stream) {
  constexpr double kFirstStep = 0.5, kShrinks = 0.6;  // standard deviations; after a round in vain
  std::vector<double> step(failures.size(), kFirstStep);
  for (int round = 0; round < kPolishRounds; ++round) {
    std::vector<Trial> trials;
    for (std::size_t i = 0; i < failures.size(); ++i) {
      const double far = failures[i].u.norm();
      for (int k = 0; k < kPolishTrials; ++k) {
        // Straight towards the origin, by the step and parts of it, or aside as well.
        Eigen::VectorXd u = failures[i].u;
        if (k < 3) {
          u *= 1 - std::min(1.0, step[i] * std::exp2(-k) / std::max(far, 1e-12));
        } else {
          const Eigen::VectorXd aside = NormalVector(stream, problem.dimensions);
          u += step[i] * aside / std::sqrt(static_cast<double>(problem.dimensions));
          if (u.norm() >= far) u *= std::max(0.0, far - 0.1 * step[i]) / std::max(u.norm(), 1e-12);
        }
        trials.push_back({u, failures[i].noise});
      }
    }
    const std::vector<TrialResult> results = problem.evaluate(trials);
    for (std::size_t i = 0; i < failures.size(); ++i) {
      bool nearer = false;
      for (std::size_t k = 0; k < kPolishTrials; ++k) {
        const std::size_t at = i * kPolishTrials + k;
        if (!results[at].failed || trials[at].u.norm() >= failures[i].u.norm()) continue;
        failures[i] = trials[at];
        nearer = true;
      }
      if (!nearer) step[i] *= kShrinks;
    }
  }
  return failures;
}

}  // namespace floorproof
