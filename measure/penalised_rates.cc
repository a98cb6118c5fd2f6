// SPDX-License-Identifier: Apache-2.0
// What is maximised, over the coefficients b:
//   the log likelihood (rate_likelihood.h) less 1/2 sum over groups g of a_g |b_g|^2.
// A group is the straight part of a smooth function, its bent part, or a product. Steps are of
// Fisher scoring. After each step every a_g moves to where the evidence (Laplace's approximation)
// is greatest:
//   a_g = (number of coefficients - a_g trace(V_gg)) / |b_g|^2, V the posterior's covariance
// (MacKay, Neural Computation 4 (1992) 415; Wood & Fasiolo, Biometrics 73 (2017) 1071), and a
// little beyond. Products are added where a score test asks for them, and dropped when they shrink
// to nothing. Members are drawn from the normal posterior.
#include "measure/penalised_rates.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

#include "base/round.h"
#include "measure/member_draws.h"
#include "measure/rate_axes.h"
#include "planners/risk/rate_evaluator.h"
#include "stats/dense_solvers.h"

namespace floorproof {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kLeastPenalty = 1e-5, kMostPenalty = 1e4;  // of functions of variance 1
constexpr double kInterceptPenalty = 1e-4;
constexpr Index kEventsForProducts = 40;
// Standard deviations of a product's score statistic above its expectation. Some sixty products of
// twelve axes are tried.
constexpr double kLeastExcess = 4;
constexpr int kMostProducts = 8, kProductRounds = 2;  // in each round
// Functions of one axis that matter: their standard deviation over the data, and how many.
constexpr double kLeastSpread = 0.2;
constexpr std::size_t kMostWholes = 5;
// Added to each group's effective number of coefficients. The evidence picks the winners among many
// groups and so overrates them; this takes the calibration's slope from 0.84-0.94 to 0.97-0.99 on
// the synthetic truths of tests/measure.
constexpr double kLessBending = 0.7;
// What a group's coefficients may be, for the posterior's covariance: at least so much as the data
// would know of them by themselves. The evidence cannot tell a small effect from none, and none
// would have no uncertainty.
constexpr double kStiffest = 12;

struct Group {
  Index begin = 0, size = 0;  // columns
  double penalty = 1;
};

class Fit {
 public:
  Fit(const std::vector<RateRow>& rows, bool per_metre, std::vector<RateAxis>& axes);

  void Run();
  LinearPredictor Result(std::string_view name) const;

 private:
  Index n() const { return static_cast<Index>(rows_.size()); }
  void AddBlock(const RateBlock& block);
  MatrixXd FeaturesOf(const RateBlock& block) const;
  void Turn(bool move_penalties);
  void MovePenalties();
  void DropEmptyProducts();
  void AddProducts(std::size_t most);
  void AddProductsOfWholes();
  VectorXd Penalty() const;
  MatrixXd InverseCovariance() const;

  const std::vector<RateRow>& rows_;
  std::vector<RateAxis>& axes_;
  RateLikelihood likelihood_;
  Index events_ = 0, others_ = 0;  // rows where it happened, and did not
  std::vector<MatrixXd> values_;   // by axis: of its functions, by row of the data
  std::vector<RateBlock> blocks_;
  MatrixXd features_;  // by row of the data; the first column is 1
  std::vector<Group> groups_;
  VectorXd coefficients_, eta_;
  Cholesky posterior_;  // of the inverse covariance
};

Fit::Fit(const std::vector<RateRow>& rows, bool per_metre, std::vector<RateAxis>& axes)
    : rows_(rows), axes_(axes), likelihood_(rows, per_metre) {
  double way = 0;
  for (const RateRow& row : rows_) {
    ++(row.happened ? events_ : others_);
    way += row.way_m;
  }
  const double share = static_cast<double>(events_) / way;
  const double eta = EtaOf(per_metre ? share : -std::log1p(-share));
  features_ = MatrixXd::Ones(n(), 1);
  coefficients_ = VectorXd::Constant(1, eta);
  std::vector<RateBlock> all;
  for (std::size_t a = 0; a < axes_.size(); ++a)
    if (!axes_[a].functions.empty()) all.push_back({{{a, 0, axes_[a].functions.size()}}});
  const RateFeatures functions(axes_, all);
  values_.resize(axes_.size());
  for (const RateBlock& block : all)
    values_[block.factors[0].axis].resize(n(), static_cast<Index>(block.size()));
  std::vector<double> row(functions.size());
  for (Index i = 0; i < n(); ++i) {
    functions.At(rows_[i].x, row);
    const double* next = row.data() + 1;
    for (const RateBlock& block : all)
      for (std::size_t k = 0; k < block.size(); ++k)
        values_[block.factors[0].axis](i, static_cast<Index>(k)) = *next++;
  }
  for (std::size_t a = 0; a < axes_.size(); ++a)
    if (!axes_[a].functions.empty()) AddBlock({{{a, 0, SmoothFunctions(axes_[a])}}});
  eta_ = features_ * coefficients_;
}

MatrixXd Fit::FeaturesOf(const RateBlock& block) const {
  MatrixXd products = MatrixXd::Ones(n(), 1);
  for (const RateFactor& factor : block.factors) {
    const Index count = static_cast<Index>(factor.count);
    MatrixXd next(n(), products.cols() * count);
    for (Index i = 0; i < products.cols(); ++i)
      for (Index k = 0; k < count; ++k)
        next.col(i * count + k) = products.col(i).cwiseProduct(
            values_[factor.axis].col(static_cast<Index>(factor.first) + k));
    products = std::move(next);
  }
  return products;
}

void Fit::AddBlock(const RateBlock& block) {
  const MatrixXd added = FeaturesOf(block);
  const Index before = features_.cols();
  features_.conservativeResize(Eigen::NoChange, before + added.cols());
  features_.rightCols(added.cols()) = added;
  coefficients_.conservativeResize(before + added.cols());
  coefficients_.tail(added.cols()).setZero();
  blocks_.push_back(block);
  const bool straight = !block.IsProduct() && axes_[block.factors[0].axis].period == 0;
  if (straight) groups_.push_back({before, 1, 1});
  if (added.cols() > straight) groups_.push_back({before + straight, added.cols() - straight, 1});
}

VectorXd Fit::Penalty() const {
  VectorXd penalty = VectorXd::Zero(features_.cols());
  penalty[0] = kInterceptPenalty;
  for (const Group& group : groups_)
    penalty.segment(group.begin, group.size).setConstant(group.penalty);
  return penalty;
}

// The cross product of features, each row weighed; rows of no weight are left out.
MatrixXd Weighed(const MatrixXd& features, const VectorXd& weight) {
  std::vector<Index> used;
  for (Index i = 0; i < weight.size(); ++i)
    if (weight[i] > 1e-9) used.push_back(i);
  MatrixXd rows(features.cols(), static_cast<Index>(used.size()));
  for (std::size_t u = 0; u < used.size(); ++u)
    rows.col(u) = features.row(used[u]).transpose() * std::sqrt(weight[used[u]]);
  MatrixXd product = MatrixXd::Zero(features.cols(), features.cols());
  product.selfadjointView<Eigen::Lower>().rankUpdate(rows);
  return product.selfadjointView<Eigen::Lower>();
}

void Fit::MovePenalties() {
  const MatrixXd covariance =
      posterior_.Solve(MatrixXd(MatrixXd::Identity(features_.cols(), features_.cols())));
  for (Group& group : groups_) {
    const double trace = covariance.diagonal().segment(group.begin, group.size).sum();
    const double used = std::max(1e-6, static_cast<double>(group.size) - group.penalty * trace);
    const double square = coefficients_.segment(group.begin, group.size).squaredNorm();
    group.penalty =
        std::clamp((used + kLessBending) / std::max(square, 1e-12), kLeastPenalty, kMostPenalty);
  }
}

void Fit::DropEmptyProducts() {
  std::vector<Index> kept = {0};  // columns; the first is the constant
  std::vector<RateBlock> blocks;
  std::vector<Group> groups;
  std::size_t g = 0;
  Index end = 1;  // of the block
  for (const RateBlock& block : blocks_) {
    end += static_cast<Index>(block.size());
    const bool stays = !block.IsProduct() || groups_[g].penalty < kMostPenalty;
    for (; g < groups_.size() && groups_[g].begin < end; ++g) {
      if (!stays) continue;
      Group group = groups_[g];
      group.begin = static_cast<Index>(kept.size());
      for (Index k = 0; k < group.size; ++k) kept.push_back(groups_[g].begin + k);
      groups.push_back(group);
    }
    if (stays) blocks.push_back(block);
  }
  if (blocks.size() == blocks_.size()) return;
  MatrixXd features(n(), kept.size());
  VectorXd coefficients(kept.size());
  for (std::size_t c = 0; c < kept.size(); ++c) {
    features.col(c) = features_.col(kept[c]);
    coefficients[c] = coefficients_[kept[c]];
  }
  features_ = std::move(features);
  coefficients_ = std::move(coefficients);
  blocks_ = std::move(blocks);
  groups_ = std::move(groups);
}

void Fit::Turn(bool move_penalties) {
  if (move_penalties) DropEmptyProducts();
  const VectorXd penalty = Penalty();
  eta_ = features_ * coefficients_;
  VectorXd score, information;
  likelihood_.ScoreAndInformation(eta_, score, information);
  MatrixXd inverse = Weighed(features_, information);
  inverse.diagonal() += penalty;
  posterior_ = Cholesky(inverse);
  const VectorXd step = posterior_.Solve(
      VectorXd(features_.transpose() * score - penalty.cwiseProduct(coefficients_)));
  const VectorXd along = features_ * step;
  const auto value = [&](double t) {
    const VectorXd at = coefficients_ + t * step;
    return likelihood_.Log(eta_ + t * along) - at.cwiseAbs2().dot(penalty) / 2;
  };
  const double before = value(0);
  double t = 1;
  while (t > 1e-3 && !(value(t) >= before)) t /= 2;
  if (t > 1e-3) {
    coefficients_ += t * step;
    eta_ += t * along;
  }
  if (move_penalties) MovePenalties();
}

// Rao's score test of each product of two axes that the fit does not have yet.
void Fit::AddProducts(std::size_t most) {
  VectorXd score, information;
  likelihood_.ScoreAndInformation(eta_, score, information);
  const MatrixXd weighed = information.asDiagonal() * features_;
  struct Candidate {
    double excess;
    RateBlock block;
  };
  std::vector<Candidate> found;
  for (std::size_t a = 0; a < axes_.size(); ++a)
    for (std::size_t b = a + 1; b < axes_.size(); ++b) {
      if (axes_[a].functions.empty() || axes_[b].functions.empty()) continue;
      const RateBlock block = {
          {{a, 0, FunctionsOfProducts(axes_[a])}, {b, 0, FunctionsOfProducts(axes_[b])}}};
      if (std::find(blocks_.begin(), blocks_.end(), block) != blocks_.end()) continue;
      const MatrixXd added = FeaturesOf(block);
      const MatrixXd across = weighed.transpose() * added;
      MatrixXd inner = added.transpose() * (information.asDiagonal() * added) -
                       across.transpose() * posterior_.Solve(across);
      const double scale = inner.diagonal().maxCoeff();
      if (!(scale > 0)) continue;
      inner.diagonal().array() += 1e-6 * scale;
      const VectorXd slope = added.transpose() * score;
      const double statistic = slope.dot(Cholesky(inner).Solve(slope));
      const double freedom = static_cast<double>(block.size());
      const double excess = (statistic - freedom) / std::sqrt(2 * freedom);
      if (excess > kLeastExcess) found.push_back({excess, block});
    }
  std::stable_sort(found.begin(), found.end(),
                   [](const Candidate& p, const Candidate& q) { return p.excess > q.excess; });
  if (found.size() > most) found.resize(most);
  for (const Candidate& candidate : found) AddBlock(candidate.block);
}

// What bends where several things come together, as a limit of height that is the product of what
// friction, speed and direction do to it. Of the axes that matter most, what eta is as a function
// of each becomes one more function of that axis, and the products of these, of two to four axes,
// one coefficient each, are added.
void Fit::AddProductsOfWholes() {
  struct Whole {
    double spread;
    std::size_t axis;
    VectorXd coefficients;
  };
  std::vector<Whole> wholes;
  Index column = 1;
  for (const RateBlock& block : blocks_) {
    const Index size = static_cast<Index>(block.size());
    const VectorXd of = coefficients_.segment(column, size);
    const double spread =
        (features_.middleCols(column, size) * of).norm() / std::sqrt(static_cast<double>(n()));
    column += size;
    if (!block.IsProduct() && spread > kLeastSpread)
      wholes.push_back({spread, block.factors[0].axis, of / spread});
  }
  std::stable_sort(wholes.begin(), wholes.end(),
                   [](const Whole& a, const Whole& b) { return a.spread > b.spread; });
  if (wholes.size() > kMostWholes) wholes.resize(kMostWholes);
  std::vector<RateFactor> factors;
  for (const Whole& whole : wholes) {
    RateAxis& axis = axes_[whole.axis];
    factors.push_back({whole.axis, axis.functions.size(), 1});
    std::vector<double> at_knots(axis.knots.size(), 0);
    for (Index k = 0; k < whole.coefficients.size(); ++k)
      for (std::size_t j = 0; j < at_knots.size(); ++j)
        at_knots[j] += whole.coefficients[k] * axis.functions[k][j];
    for (double& value : at_knots) value = RoundedTo6(value);
    axis.functions.push_back(std::move(at_knots));
    MatrixXd& values = values_[whole.axis];
    values.conservativeResize(Eigen::NoChange, values.cols() + 1);
    values.rightCols(1) = values.leftCols(whole.coefficients.size()) * whole.coefficients;
  }
  for (unsigned chosen = 1; chosen < 1u << factors.size(); ++chosen) {
    if (std::popcount(chosen) < 2 || std::popcount(chosen) > 4) continue;
    RateBlock block;
    for (std::size_t w = 0; w < factors.size(); ++w)
      if (chosen >> w & 1) block.factors.push_back(factors[w]);
    AddBlock(block);
  }
}

void Fit::Run() {
  const auto turns = [&](int count, bool move_penalties) {
    for (int t = 0; t < count; ++t) Turn(move_penalties);
  };
  turns(3, false);
  turns(10, true);
  if (std::min(events_, others_) >= kEventsForProducts) {
    for (int round = 0; round < kProductRounds; ++round) {
      AddProducts(kMostProducts);
      turns(10, true);
    }
    AddProductsOfWholes();
    turns(15, true);
  }
  turns(6, false);
}

MatrixXd Fit::InverseCovariance() const {
  VectorXd score, information;
  likelihood_.ScoreAndInformation(eta_, score, information);
  MatrixXd inverse = Weighed(features_, information);
  VectorXd penalty = Penalty();
  for (const Group& group : groups_) {
    const double known = inverse.diagonal().segment(group.begin, group.size).mean();
    penalty.segment(group.begin, group.size)
        .setConstant(std::min(group.penalty, kStiffest * known));
  }
  inverse.diagonal() += penalty;
  return inverse;
}

std::vector<double> Rounded(const VectorXd& from) {
  std::vector<double> to(from.data(), from.data() + from.size());
  for (double& value : to) value = RoundedTo6(value);
  return to;
}

LinearPredictor Fit::Result(std::string_view name) const {
  // Of the probability that it happens (in a metre) by the coefficients.
  const VectorXd by_eta = eta_.unaryExpr([](double eta) {
    const double p = 1 / (1 + std::exp(-eta));
    return p * (1 - p);
  });
  const MatrixXd deviations =
      MemberDeviations(InverseCovariance(), by_eta.asDiagonal() * features_, name);
  LinearPredictor of;
  of.events = static_cast<int>(events_);
  of.blocks = blocks_;
  of.coefficients = Rounded(coefficients_);
  for (Index r = 0; r < deviations.cols(); ++r)
    of.members.push_back(Rounded(coefficients_ + deviations.col(r)));
  return of;
}

}  // namespace

LinearPredictor FitPredictor(const std::vector<RateRow>& rows, bool per_metre,
                             std::string_view name, std::vector<RateAxis>& axes) {
  Fit fit(rows, per_metre, axes);
  fit.Run();
  return fit.Result(name);
}

}  // namespace floorproof
