// SPDX-License-Identifier: Apache-2.0
#include "planners/risk/rate_evaluator.h"

#include <algorithm>
#include <cmath>

namespace floorproof {
namespace {

// Sixteen numbers of mean 0 and variance 1, as of a normal distribution: its quantiles in the
// middle of sixteen equal shares.
constexpr std::array<double, kRateMembers> kScores = {
    -1.9382, -1.3714, -1.0509, -0.8079, -0.6026, -0.4185, -0.2468, -0.0816,
    0.0816,  0.2468,  0.4185,  0.6026,  0.8079,  1.0509,  1.3714,  1.9382};
// Of this member for this axis: the axes' are shuffled against each other.
double Score(std::size_t member, std::size_t axis) {
  return kScores[(member * 5 + axis * 3) % kRateMembers];
}

// Farther beyond than this, in ranges, it counts as this.
constexpr double kMostBeyond = 3;
// What eta may change by over the range of an axis that shows no effect, or never varied.
constexpr double kLeastChange = 0.25;

// Of a function of the axis, over its range.
double Change(const RateAxis& axis, const Eigen::VectorXd& of_functions, std::size_t first) {
  Eigen::VectorXd eta = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(axis.knots.size()));
  for (Eigen::Index k = 0; k < of_functions.size(); ++k)
    eta += of_functions[k] *
           Eigen::Map<const Eigen::VectorXd>(
               axis.functions[first + static_cast<std::size_t>(k)].data(), eta.size());
  return eta.maxCoeff() - eta.minCoeff();
}

// What a block changes by over the range of one of its axes, where the others' functions, whose
// mean square is 1 or less, are as usual.
double Change(const std::vector<RateAxis>& axes, const RateBlock& block,
              std::span<const double> coefficients, std::size_t which) {
  std::size_t behind = 1;  // products for each function of the factor
  for (std::size_t f = which + 1; f < block.factors.size(); ++f) behind *= block.factors[f].count;
  const RateFactor& factor = block.factors[which];
  double squares = 0;
  Eigen::VectorXd of_functions(static_cast<Eigen::Index>(factor.count));
  for (std::size_t i = 0; i < block.size() / factor.count; ++i) {
    const std::size_t begin = i / behind * behind * factor.count + i % behind;
    for (std::size_t k = 0; k < factor.count; ++k)
      of_functions[static_cast<Eigen::Index>(k)] = coefficients[begin + k * behind];
    squares += std::pow(Change(axes[factor.axis], of_functions, factor.first), 2);
  }
  return std::sqrt(squares);
}

std::vector<RateBlock> AllBlocks(const KindRates& kind) {
  std::vector<RateBlock> all;
  const auto add = [&](const LinearPredictor& predictor) {
    for (const RateBlock& block : predictor.blocks)
      if (std::find(all.begin(), all.end(), block) == all.end()) all.push_back(block);
  };
  add(kind.any);
  for (const ModeSplit& split : kind.splits) add(split.of);
  return all;
}

double OnAxis(const RateAxis& axis, double x) {
  if (axis.period == 0) return std::clamp(x, axis.lower, axis.upper);
  x = std::fmod(x - axis.lower, axis.period);
  if (x < 0) x += axis.period;
  const double range = axis.upper - axis.lower;
  if (x <= range) return axis.lower + x;
  return x - range <= axis.period - x ? axis.upper : axis.lower;
}

Eigen::MatrixXd ByKnot(const RateAxis& axis) {
  Eigen::MatrixXd values(axis.knots.size(), axis.functions.size());
  for (std::size_t k = 0; k < axis.functions.size(); ++k)
    for (std::size_t j = 0; j < axis.knots.size(); ++j) values(j, k) = axis.functions[k][j];
  return values;
}

}  // namespace

RateFeatures::RateFeatures(const std::vector<RateAxis>& axes, std::vector<RateBlock> blocks)
    : axes_(axes), blocks_(std::move(blocks)) {
  for (const RateAxis& axis : axes_) {
    axis_begins_.push_back(axis_functions_);
    axis_functions_ += axis.functions.size();
    curves_.emplace_back();
    if (!axis.functions.empty())
      curves_.back().emplace(axis.knots, ByKnot(axis), axis.period == axis.upper - axis.lower);
  }
  for (const RateBlock& block : blocks_) {
    begins_.push_back(size_);
    size_ += block.size();
  }
}

void RateFeatures::At(std::span<const double> x, std::span<double> out) const {
  thread_local std::vector<double> values;
  values.resize(axis_functions_);
  for (std::size_t a = 0; a < axes_.size(); ++a)
    if (curves_[a])
      curves_[a]->At(OnAxis(axes_[a], x[a]),
                     {values.data() + axis_begins_[a], axes_[a].functions.size()});
  out[0] = 1;
  double* products = out.data() + 1;
  for (const RateBlock& block : blocks_) {
    std::size_t size = 1;
    products[0] = 1;
    for (const RateFactor& factor : block.factors) {
      const double* of = values.data() + axis_begins_[factor.axis] + factor.first;
      for (std::size_t i = size; i-- > 0;)  // from behind: each is read before it is written over
        for (std::size_t k = factor.count; k-- > 0;)
          products[i * factor.count + k] = products[i] * of[k];
      size *= factor.count;
    }
    products += size;
  }
}

RateEvaluator::RateEvaluator(const KindRates& kind)
    : kind_(kind), last_(LastMode(kind)), features_(kind.axes, AllBlocks(kind)) {
  if (!kind.per_metre)  // whose metres count as it is
    for (const RateAxis& axis : kind.axes) {
      if (axis.of_hazard || axis.upper <= 0) continue;
      if (axis.name == "over_m") longest_m_ = axis.upper;
      if (axis.name == "turn_rad") most_turn_rad_ = axis.upper;
    }
  best_.setZero(features_.size(), kEtas);
  members_ = Rows::Zero(features_.size(), kEtas * kRateMembers);
  change_ = Rows::Zero(kind.axes.size(), kEtas);
  for (Eigen::Index e = 0; e < kEtas; ++e) {
    const LinearPredictor& of = predictor(e);
    const auto place = [&](const std::vector<double>& from, auto& to, Eigen::Index column) {
      to(0, column) = from[0];
      std::size_t next = 1;
      for (const RateBlock& block : of.blocks)
        for (std::size_t b = 0; b < features_.blocks().size(); ++b)
          if (features_.blocks()[b] == block) {
            for (std::size_t k = 0; k < block.size(); ++k)
              to(features_.begin(b) + k, column) = from[next + k];
            next += block.size();
          }
    };
    place(of.coefficients, best_, e);
    for (std::size_t r = 0; r < kRateMembers; ++r) place(of.members[r], members_, r * kEtas + e);
    std::size_t next = 1;
    for (const RateBlock& block : of.blocks) {
      const std::span<const double> coefficients(of.coefficients.data() + next, block.size());
      for (std::size_t f = 0; f < block.factors.size(); ++f)
        change_(block.factors[f].axis, e) = std::hypot(change_(block.factors[f].axis, e),
                                                       Change(kind.axes, block, coefficients, f));
      next += block.size();
    }
  }
  change_ = change_.cwiseMax(kLeastChange);
}

double RateEvaluator::Beyond(std::span<const double> x) const {
  double most = 0;
  for (std::size_t a = 0; a < x.size(); ++a)
    most = std::max(most, floorproof::Beyond(kind_.axes[a], x[a]));
  return most;
}

ModeNumbers RateEvaluator::RatesOf(const Etas& etas) const {
  ModeNumbers rates;
  double left = RateOf(etas[0]);
  for (std::size_t k = 0; k < kind_.splits.size(); ++k) {
    const double odds = std::exp(-etas[static_cast<Eigen::Index>(k) + 1]);  // of those left
    const double taken = left / (1 + odds);
    rates[static_cast<std::size_t>(kind_.splits[k].mode)] = taken;
    left = std::max(0.0, left - taken);
  }
  rates[static_cast<std::size_t>(last_)] = left;
  return rates;
}

ModeNumbers RateEvaluator::At(std::span<const double> x) const {
  thread_local std::vector<double> features;
  features.resize(features_.size());
  features_.At(x, features);
  Etas etas = Etas::Zero();
  for (std::size_t f = 0; f < features.size(); ++f)
    etas += features[f] * best_.row(static_cast<Eigen::Index>(f)).array();
  return RatesOf(etas);
}

std::array<ModeNumbers, kRateMembers> RateEvaluator::MembersAt(std::span<const double> x) const {
  std::vector<double> features(features_.size());
  features_.At(x, features);
  const Eigen::Map<const Eigen::RowVectorXd> row(features.data(), features.size());
  Eigen::RowVectorXd etas = row * members_;
  for (std::size_t a = 0; a < x.size(); ++a) {
    const double beyond = std::min(floorproof::Beyond(kind_.axes[a], x[a]), kMostBeyond);
    if (beyond == 0) continue;
    for (std::size_t r = 0; r < kRateMembers; ++r)
      etas.segment<kEtas>(r * kEtas) += Score(r, a) * beyond * change_.row(a);
  }
  std::array<ModeNumbers, kRateMembers> rates;
  for (std::size_t r = 0; r < kRateMembers; ++r)
    rates[r] = RatesOf(etas.segment<kEtas>(r * kEtas).array());
  return rates;
}

}  // namespace floorproof
