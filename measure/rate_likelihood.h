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
  double way_m = 1;       // of an exposure; of a meeting, how much of it there was: 1, all
  bool happened = false;
};

// Per metre: a Poisson process with rate log(1 + exp(eta)), which ends where it happened. Else it
// happens with probability 1 / (1 + exp(-eta)) = 1 - exp(-log(1 + exp(eta))). Etas are by row.
// Half an event more is spread evenly over all rows (of a metre's rate: over all way), and half an
// event less over those that are events, so that the odds of all rows are as constant shares have
// them (constant_rate.h). Else nothing would hold eta where nothing ever happened.
class RateLikelihood {
 public:
  RateLikelihood(const std::vector<RateRow>& rows, bool per_metre);

  double Log(const Eigen::VectorXd& eta) const;
  // By eta, by row: first derivative, and expectation of minus the second.
  void ScoreAndInformation(const Eigen::VectorXd& eta, Eigen::VectorXd& score,
                           Eigen::VectorXd& information) const;

 private:
  bool per_metre_;
  Eigen::ArrayXd events_, way_;  // by row
};

}  // namespace floorproof
