// SPDX-License-Identifier: Apache-2.0
// The likelihood of what happened or did not, under one eta, and its derivatives.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "planners/risk/rate_model.h"

namespace floorproof {

// A meeting, or a failure, as the fit of one eta sees it.
struct RateRow {
  std::vector<double> x;  // by axis
  double way_m = 1;       // of an exposure; 1 where it is a meeting's
  bool happened = false;
};

// Per metre: a Poisson process with rate log(1 + exp(eta)), which ends where it happened. Else it
// happens with probability 1 / (1 + exp(-eta)) = 1 - exp(-log(1 + exp(eta))). Etas are by row.
class RateLikelihood {
 public:
  RateLikelihood(const std::vector<RateRow>& rows, bool per_metre)  // the rows outlive it
      : rows_(rows), per_metre_(per_metre) {}

  double Log(const Eigen::VectorXd& eta) const;
  // By eta, by row: first derivative, and expectation of minus the second.
  void ScoreAndInformation(const Eigen::VectorXd& eta, Eigen::VectorXd& score,
                           Eigen::VectorXd& information) const;

 private:
  const std::vector<RateRow>& rows_;
  bool per_metre_;
};

}  // namespace floorproof
