// SPDX-License-Identifier: Apache-2.0
// The likelihood of measured meetings under rates that compete, and its derivatives.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "planners/risk/rate_model.h"

namespace floorproof {

// A meeting as a fit sees it.
struct RateRow {
  std::vector<double> x;  // by axis
  double way_m = 1;       // of an exposure; 1 where rates are a meeting's
  int mode = -1;          // that ended it; -1: cleared
};

// At given rates of all rows and modes: a meeting's, or (per_metre) a metre's.
class RateLikelihood {
 public:
  RateLikelihood(const std::vector<RateRow>& rows, bool per_metre);  // the rows outlive it

  void SetRate(int mode, const Eigen::VectorXd& by_row);
  const Eigen::MatrixXd& rates() const { return rates_; }  // by row, by mode
  const Eigen::VectorXd& total() const { return total_; }  // by row: Lambda

  // With the mode's rates by these etas (rate_model.h) in place of those that were set.
  double LogLikelihood(int mode, const Eigen::VectorXd& eta) const;
  // By the mode's eta, by row: first derivative, and expectation of minus the second.
  void ScoreAndInformation(int mode, Eigen::VectorXd& score, Eigen::VectorXd& information) const;
  // By the etas of two modes, by row: expectation of minus the mixed second derivative.
  Eigen::VectorXd SharedInformation(int one, int other) const;
  // Meetings, or way, each counted up to where it ended: events of a mode by this are its rate.
  double Exposure() const;

 private:
  const std::vector<RateRow>& rows_;
  bool per_metre_;
  Eigen::MatrixXd rates_;
  Eigen::VectorXd total_;
};

}  // namespace floorproof
