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

RateLikelihood::RateLikelihood(const std::vector<RateRow>& rows, bool per_metre)
    : per_metre_(per_metre), events_(Index(rows.size())), way_(Index(rows.size())) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    events_[Index(i)] = rows[i].happened;
    way_[Index(i)] = rows[i].way_m;
  }
  constexpr double kMore = 0.5;
  if (per_metre_)
    events_ += kMore * way_ / way_.sum();
  else
    events_ += kMore / way_.sum() * (way_ - 2 * events_);
}

double RateLikelihood::Log(const VectorXd& eta) const {
  double sum = 0;
  for (Index i = 0; i < eta.size(); ++i) {
    const double rate = RateOf(eta[i]);
    sum += events_[i] * (per_metre_ ? std::log(std::max(rate, kNoRate)) : eta[i]) - rate * way_[i];
  }
  return sum;
}

void RateLikelihood::ScoreAndInformation(const VectorXd& eta, VectorXd& score,
                                         VectorXd& information) const {
  score.resize(eta.size());
  information.resize(eta.size());
  for (Index i = 0; i < eta.size(); ++i) {
    const double p = 1 / (1 + std::exp(-eta[i]));  // also the slope of the rate by eta
    if (per_metre_) {
      const double rate = std::max(RateOf(eta[i]), kNoRate);
      score[i] = p * (events_[i] / rate - way_[i]);
      information[i] = p * p * way_[i] / rate;
    } else {
      score[i] = events_[i] - way_[i] * p;
      information[i] = way_[i] * p * (1 - p);
    }
  }
}

}  // namespace floorproof
