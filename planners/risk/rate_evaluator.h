// SPDX-License-Identifier: Apache-2.0
// The rates of one kind of meeting, made ready to be asked many times.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "planners/risk/cubic_functions.h"
#include "planners/risk/rate_model.h"

namespace floorproof {

// All functions and products of functions that some eta is made of, at one x.
class RateFeatures {
 public:
  // The axes outlive it.
  RateFeatures(const std::vector<RateAxis>& axes, std::vector<RateBlock> blocks);

  std::size_t size() const { return size_; }  // the constant included, which is the first
  const std::vector<RateBlock>& blocks() const { return blocks_; }
  std::size_t begin(std::size_t block) const { return begins_[block]; }
  // x is taken at the nearest place that was measured.
  void At(std::span<const double> x, std::span<double> out) const;

 private:
  const std::vector<RateAxis>& axes_;
  std::vector<RateBlock> blocks_;
  std::vector<std::size_t> begins_;
  std::vector<std::optional<CubicFunctions>> curves_;  // by axis; none: it never varied
  std::vector<std::size_t> axis_begins_;
  std::size_t axis_functions_ = 0, size_ = 1;
};

class RateEvaluator {
 public:
  explicit RateEvaluator(const KindRates& kind);  // outlives it
  const KindRates& kind() const { return kind_; }

  // As how many of the longest that were measured a meeting counts that is longer, or of those with
  // the most turns one that turns more: at least 1.
  double TimesMeasured(const Approach& at) const {
    return std::max({1.0, at.over_m / longest_m_, std::abs(at.turn_rad) / most_turn_rad_});
  }
  // Largest over the axes (rate_model.h).
  double Beyond(std::span<const double> x) const;
  // By the best coefficients. A meeting's, or a metre's.
  ModeNumbers At(std::span<const double> x) const;
  // By each member of the posterior. Beyond what was measured they part: by a whole range beyond,
  // each eta is as uncertain (one standard deviation) as all that it changes over that range, at
  // least by a quarter; from three ranges on no more.
  std::array<ModeNumbers, kRateMembers> MembersAt(std::span<const double> x) const;

 private:
  // Of any failure, then the splits'.
  static constexpr Eigen::Index kEtas = kNumFailureModes;
  using Etas = Eigen::Array<double, 1, kEtas>;
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const LinearPredictor& predictor(Eigen::Index eta) const {
    return eta == 0 ? kind_.any : kind_.splits[eta - 1].of;
  }
  ModeNumbers RatesOf(const Etas& etas) const;

  const KindRates& kind_;
  FailureMode last_;
  double longest_m_ =
      std::numeric_limits<double>::infinity();  // measured; of any length: not known
  double most_turn_rad_ = std::numeric_limits<double>::infinity();
  RateFeatures features_;
  Eigen::Matrix<double, Eigen::Dynamic, kEtas, Eigen::RowMajor> best_;  // by feature
  Rows members_;  // by feature, by member and eta
  Rows change_;   // by axis, by eta: what it may change by over the axis's range
};

}  // namespace floorproof
