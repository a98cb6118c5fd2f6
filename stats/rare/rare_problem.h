// SPDX-License-Identifier: Apache-2.0
// What rare failures are looked for in: coordinates that are standard normal, streams of noise, and
// trials that say whether it failed and how far from failing it was.
#pragma once

#include <Eigen/Core>
#include <compare>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace floorproof {

struct Trial {
  Eigen::VectorXd u;        // standard normal coordinates
  std::uint64_t noise = 0;  // which streams: trials of the same number share all of their noise
};

struct TrialResult {
  bool failed = false;
  // Least first: how far from failing, then a second measure that splits ties of the first. Neither
  // says whether it failed.
  double score = 0, second = 0;
  // It was a trial: else it says nothing, and is no failure.
  bool counts = true;
};

struct RareProblem {
  Eigen::Index dimensions = 1;
  bool noisy = false;  // the same coordinates may come to something else with other noise
  // The results of trials that may be run at the same time, in their order.
  std::function<std::vector<TrialResult>(std::span<const Trial>)> evaluate;
};

// Which of two trials is nearer to a failure; one that failed is nearer than any that did not.
inline std::partial_ordering Nearness(const TrialResult& a, const TrialResult& b) {
  if (a.failed != b.failed)
    return a.failed ? std::partial_ordering::less : std::partial_ordering::greater;
  if (a.failed) return std::partial_ordering::equivalent;
  if (a.score != b.score) return a.score <=> b.score;
  return a.second <=> b.second;
}
inline bool AsNear(const TrialResult& a, const TrialResult& than) { return Nearness(a, than) <= 0; }

}  // namespace floorproof
