// SPDX-License-Identifier: Apache-2.0
#include "measure/rate_likelihood.h"

#include <algorithm>
#include <cmath>

namespace floorproof {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kNoRate = 1e-300;  // what underflows

}  // namespace

double RateLikelihood::Log(const VectorXd& eta) const {
  double sum = 0;
  for (Index i = 0; i < eta.size(); ++i) {
    const RateRow& row = rows_[i];
    const double rate = RateOf(eta[i]);
    const double of_event = per_metre_ ? std::log(std::max(rate, kNoRate)) : eta[i];
    sum += (row.happened ? of_event : 0) - rate * row.way_m;
  }
  return sum;
}

void RateLikelihood::ScoreAndInformation(const VectorXd& eta, VectorXd& score,
                                         VectorXd& information) const {
  score.resize(eta.size());
  information.resize(eta.size());
  for (Index i = 0; i < eta.size(); ++i) {
    const RateRow& row = rows_[i];
    const double p = 1 / (1 + std::exp(-eta[i]));  // also the slope of the rate by eta
    if (per_metre_) {
      const double rate = std::max(RateOf(eta[i]), kNoRate);
      score[i] = p * (row.happened / rate - row.way_m);
      information[i] = p * p * row.way_m / rate;
    } else {
      score[i] = row.happened - p;
      information[i] = p * (1 - p);
    }
  }
}

}  // namespace floorproof
