// SPDX-License-Identifier: Apache-2.0
// A meeting that mode m ends has likelihood lambda_m / Lambda (1 - exp(-Lambda)); of an exposure
// the way at which m ended it is known: lambda_m exp(-Lambda way).
#include "measure/rate_likelihood.h"

#include <cmath>

namespace floorproof {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kNoRate = 1e-9;  // before any is set

// Of a truncated exponential: the mean share of a meeting done when it ended, times its exposure.
double MeanExposure(double total) {
  return total < 1e-4 ? 0.5 - total / 12 : 1 / total - 1 / std::expm1(total);
}

}  // namespace

RateLikelihood::RateLikelihood(const std::vector<RateRow>& rows, bool per_metre)
    : rows_(rows),
      per_metre_(per_metre),
      rates_(Eigen::MatrixXd::Constant(Index(rows.size()), kNumFailureModes, kNoRate)),
      total_(rates_.rowwise().sum()) {}

void RateLikelihood::SetRate(int mode, const VectorXd& by_row) {
  rates_.col(mode) = by_row.cwiseMax(kNoRate);
  total_ = rates_.rowwise().sum();
}

// Way, or meetings, each counted up to where it ended.
double RateLikelihood::Exposure() const {
  double sum = 0;
  for (Index i = 0; i < total_.size(); ++i) {
    const RateRow& row = rows_[i];
    const bool whole = per_metre_ || row.mode < 0;
    sum += whole ? row.way_m : MeanExposure(total_[i]);
  }
  return sum;
}

double RateLikelihood::LogLikelihood(int mode, const VectorXd& eta) const {
  double sum = 0;
  for (Index i = 0; i < total_.size(); ++i) {
    const double rate = RateOf(eta[i]), total = total_[i] - rates_(i, mode) + rate;
    const RateRow& row = rows_[i];
    const double of_row = row.mode == mode ? rate : row.mode < 0 ? 0 : rates_(i, row.mode);
    if (row.mode < 0)
      sum -= total * row.way_m;
    else if (per_metre_)
      sum += std::log(of_row) - total * row.way_m;
    else
      sum += std::log(of_row / total) + std::log(-std::expm1(-total));
  }
  return sum;
}

// Of eta of the mode, by row: first derivative, and expectation of minus the second.
void RateLikelihood::ScoreAndInformation(int mode, VectorXd& score, VectorXd& information) const {
  score.resize(total_.size());
  information.resize(total_.size());
  for (Index i = 0; i < total_.size(); ++i) {
    const RateRow& row = rows_[i];
    const double rate = rates_(i, mode), total = total_[i];
    const double slope = -std::expm1(-rate);  // of the rate by eta
    if (per_metre_) {
      score[i] = slope * ((row.mode == mode ? 1 / rate : 0) - row.way_m);
      information[i] = slope * slope * row.way_m / rate;
      continue;
    }
    const double cleared = std::exp(-total), ended = MeanExposure(total);
    const double first = rate / total * -std::expm1(-total);
    score[i] = slope * (row.mode < 0 ? -1 : (row.mode == mode ? 1 / rate : 0) - ended);
    const double by_mode = 1 / rate - ended;
    information[i] =
        slope * slope *
        (cleared + first * by_mode * by_mode + std::max(0.0, 1 - cleared - first) * ended * ended);
  }
}

// Of the etas of two modes, by row: expectation of minus the mixed second derivative.
VectorXd RateLikelihood::SharedInformation(int one, int other) const {
  VectorXd shared = VectorXd::Zero(total_.size());
  if (per_metre_) return shared;
  for (Index i = 0; i < total_.size(); ++i) {
    const double p = rates_(i, one), q = rates_(i, other), total = total_[i];
    const double cleared = std::exp(-total), ended = MeanExposure(total);
    const double share = -std::expm1(-total) / total;  // of the rates: who came first
    const double by_rates = cleared - 2 * share * ended + (1 - cleared) * ended * ended;
    shared[i] = std::expm1(-p) * std::expm1(-q) * by_rates;
  }
  return shared;
}

}  // namespace floorproof
