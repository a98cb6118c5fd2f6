// SPDX-License-Identifier: Apache-2.0
// What is maximised, over the coefficients b of all modes (rate_model.h has the rates):
//   sum over meetings of  -Lambda                                         if cleared,
//                         log lambda_m - log Lambda + log(1 - exp(-Lambda)) if m ended it,
//   (of exposures:        -Lambda way,  log lambda_m - Lambda way)
//   less 1/2 sum over groups g of a_g |b_g|^2.
// A group is the straight part of a smooth function, its bent part, or a product. The modes take
// turns: Fisher scoring on one mode's coefficients, the others held. After each turn every a_g
// moves to where the evidence (Laplace's approximation) is greatest:
//   a_g = (number of coefficients - a_g trace(V_gg)) / |b_g|^2, V the posterior's covariance
// (MacKay, Neural Computation 4 (1992) 415; Wood & Fasiolo, Biometrics 73 (2017) 1071), and a
// little beyond. Products are added where a score test asks for them, and dropped when they shrink
// to nothing. Members are drawn from the normal posterior of all modes together.
#include "measure/penalised_rates.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <string>

#include "base/round.h"
#include "measure/constant_rate.h"
#include "measure/member_draws.h"
#include "measure/rate_axes.h"
#include "planners/risk/rate_evaluator.h"

namespace floorproof {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kLeastPenalty = 1e-5, kMostPenalty = 1e4;  // of functions of variance 1
constexpr double kInterceptPenalty = 1e-4;
constexpr int kEventsForProducts = 40;
// Standard deviations of a product's score statistic above its expectation. Some sixty products of
// twelve axes are tried.
constexpr double kLeastExcess = 4;
constexpr int kMostProducts = 8, kProductRounds = 2;  // of one mode, in each round
// Functions of one axis that matter: their standard deviation over the data, and how many.
constexpr double kLeastSpread = 0.2;
constexpr std::size_t kMostWholes = 5;
// Added to each group's effective number of coefficients. The evidence picks the winners among many
// groups and so overrates them; this takes the calibration's slope from 0.75 to 0.9-1.1 on the
// synthetic truths of tests/measure.
constexpr double kLessBending = 0.7;
// What a group's coefficients may be, for the posterior's covariance: at least so much as the data
// would know of them by themselves. The evidence cannot tell a small effect from none, and none
// would have no uncertainty.
constexpr double kStiffest = 8;

struct Group {
  Index begin = 0, size = 0;  // columns
  double penalty = 1;
};

// One mode's part of the fit.
struct ModeFit {
  std::vector<RateBlock> blocks;
  MatrixXd features;  // by row of the data; the first column is 1
  std::vector<Group> groups;
  VectorXd coefficients;
  VectorXd eta;
  Eigen::LLT<MatrixXd> posterior;  // of the inverse covariance
};

class Fit {
 public:
  Fit(const std::vector<RateRow>& rows, KindRates& kind)
      : rows_(rows), kind_(kind), likelihood_(rows, kind.per_metre) {}

  void Run();
  void Write(std::string_view name);

 private:
  Index n() const { return static_cast<Index>(rows_.size()); }
  void Begin();
  void AddBlock(ModeFit& fit, const RateBlock& block);
  MatrixXd FeaturesOf(const RateBlock& block) const;
  void Turn(int mode, bool move_penalties);
  void SetConstants();
  void MovePenalties(ModeFit& fit) const;
  void DropEmptyProducts(ModeFit& fit) const;
  void AddProducts(int mode, std::size_t most);
  void AddProductsOfWholes(int mode);
  VectorXd PenaltyOf(const ModeFit& fit) const;
  MatrixXd InverseCovariance() const;
  MatrixXd FailureSlopes() const;

  const std::vector<RateRow>& rows_;
  KindRates& kind_;
  std::array<std::optional<ModeFit>, kNumFailureModes> fits_;
  RateLikelihood likelihood_;
};

MatrixXd Fit::FeaturesOf(const RateBlock& block) const {
  const RateFeatures features(kind_.axes, {block});
  MatrixXd values(n(), static_cast<Index>(features.size()) - 1);
  std::vector<double> row(features.size());
  for (Index i = 0; i < n(); ++i) {
    features.At(rows_[i].x, row);
    for (Index k = 0; k < values.cols(); ++k) values(i, k) = row[k + 1];
  }
  return values;
}

void Fit::AddBlock(ModeFit& fit, const RateBlock& block) {
  const MatrixXd added = FeaturesOf(block);
  const Index before = fit.features.cols();
  fit.features.conservativeResize(Eigen::NoChange, before + added.cols());
  fit.features.rightCols(added.cols()) = added;
  fit.coefficients.conservativeResize(before + added.cols());
  fit.coefficients.tail(added.cols()).setZero();
  fit.blocks.push_back(block);
  const bool straight = !block.IsProduct() && kind_.axes[block.factors[0].axis].period == 0;
  if (straight) fit.groups.push_back({before, 1, 1});
  if (added.cols() > straight)
    fit.groups.push_back({before + straight, added.cols() - straight, 1});
}

void Fit::Begin() {
  for (int m = 0; m < kNumFailureModes; ++m) {
    ModeRates& mode = kind_.modes[m];
    if (mode.events < kLeastEvents) continue;
    ModeFit& fit = fits_[m].emplace();
    fit.features = MatrixXd::Ones(n(), 1);
    const double rate = std::min(mode.events / likelihood_.Exposure(), 3.0);
    fit.coefficients = VectorXd::Constant(1, EtaOf(rate));
    for (std::size_t a = 0; a < kind_.axes.size(); ++a)
      if (!kind_.axes[a].functions.empty())
        AddBlock(fit, {{{a, 0, kind_.axes[a].functions.size()}}});
    fit.eta = fit.features * fit.coefficients;
    likelihood_.SetRate(m, fit.eta.unaryExpr(&RateOf));
  }
  SetConstants();
}

void Fit::SetConstants() {
  for (int m = 0; m < kNumFailureModes; ++m)
    if (!fits_[m])
      likelihood_.SetRate(m,
                          VectorXd::Constant(n(), kind_.modes[m].events / likelihood_.Exposure()));
}

VectorXd Fit::PenaltyOf(const ModeFit& fit) const {
  VectorXd penalty = VectorXd::Zero(fit.features.cols());
  penalty[0] = kInterceptPenalty;
  for (const Group& group : fit.groups)
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

void Fit::MovePenalties(ModeFit& fit) const {
  const MatrixXd covariance =
      fit.posterior.solve(MatrixXd::Identity(fit.features.cols(), fit.features.cols()));
  for (Group& group : fit.groups) {
    const double trace = covariance.diagonal().segment(group.begin, group.size).sum();
    const double used = std::max(1e-6, static_cast<double>(group.size) - group.penalty * trace);
    const double square = fit.coefficients.segment(group.begin, group.size).squaredNorm();
    group.penalty =
        std::clamp((used + kLessBending) / std::max(square, 1e-12), kLeastPenalty, kMostPenalty);
  }
}

void Fit::DropEmptyProducts(ModeFit& fit) const {
  std::vector<Index> kept = {0};  // columns; the first is the constant
  std::vector<RateBlock> blocks;
  std::vector<Group> groups;
  std::size_t g = 0;
  Index end = 1;  // of the block
  for (const RateBlock& block : fit.blocks) {
    end += static_cast<Index>(block.size());
    const bool stays = !block.IsProduct() || fit.groups[g].penalty < kMostPenalty;
    for (; g < fit.groups.size() && fit.groups[g].begin < end; ++g) {
      if (!stays) continue;
      Group group = fit.groups[g];
      group.begin = static_cast<Index>(kept.size());
      for (Index k = 0; k < group.size; ++k) kept.push_back(fit.groups[g].begin + k);
      groups.push_back(group);
    }
    if (stays) blocks.push_back(block);
  }
  if (blocks.size() == fit.blocks.size()) return;
  MatrixXd features(n(), kept.size());
  VectorXd coefficients(kept.size());
  for (std::size_t c = 0; c < kept.size(); ++c) {
    features.col(c) = fit.features.col(kept[c]);
    coefficients[c] = fit.coefficients[kept[c]];
  }
  fit.features = std::move(features);
  fit.coefficients = std::move(coefficients);
  fit.blocks = std::move(blocks);
  fit.groups = std::move(groups);
}

void Fit::Turn(int mode, bool move_penalties) {
  ModeFit& fit = *fits_[mode];
  if (move_penalties) DropEmptyProducts(fit);
  const VectorXd penalty = PenaltyOf(fit);
  fit.eta = fit.features * fit.coefficients;
  VectorXd score, information;
  likelihood_.ScoreAndInformation(mode, score, information);
  MatrixXd inverse = Weighed(fit.features, information);
  inverse.diagonal() += penalty;
  fit.posterior.compute(inverse);
  const VectorXd step = fit.posterior.solve(fit.features.transpose() * score -
                                            penalty.cwiseProduct(fit.coefficients));
  const VectorXd along = fit.features * step;
  const auto value = [&](double t) {
    const VectorXd at = fit.coefficients + t * step;
    return likelihood_.LogLikelihood(mode, fit.eta + t * along) - at.cwiseAbs2().dot(penalty) / 2;
  };
  const double before = value(0);
  double t = 1;
  while (t > 1e-3 && !(value(t) >= before)) t /= 2;
  if (t > 1e-3) {
    fit.coefficients += t * step;
    fit.eta += t * along;
    likelihood_.SetRate(mode, fit.eta.unaryExpr(&RateOf));
  }
  if (move_penalties) MovePenalties(fit);
}

// Rao's score test of each product of two axes that the fit does not have yet.
void Fit::AddProducts(int mode, std::size_t most) {
  ModeFit& fit = *fits_[mode];
  VectorXd score, information;
  likelihood_.ScoreAndInformation(mode, score, information);
  const MatrixXd weighed = information.asDiagonal() * fit.features;
  struct Candidate {
    double excess;
    RateBlock block;
  };
  std::vector<Candidate> found;
  for (std::size_t a = 0; a < kind_.axes.size(); ++a)
    for (std::size_t b = a + 1; b < kind_.axes.size(); ++b) {
      if (kind_.axes[a].functions.empty() || kind_.axes[b].functions.empty()) continue;
      const RateBlock block = {
          {{a, 0, FunctionsOfProducts(kind_.axes[a])}, {b, 0, FunctionsOfProducts(kind_.axes[b])}}};
      if (std::find(fit.blocks.begin(), fit.blocks.end(), block) != fit.blocks.end()) continue;
      const MatrixXd added = FeaturesOf(block);
      const MatrixXd across = weighed.transpose() * added;
      MatrixXd inner = added.transpose() * (information.asDiagonal() * added) -
                       across.transpose() * fit.posterior.solve(across);
      const double scale = inner.diagonal().maxCoeff();
      if (!(scale > 0)) continue;
      inner.diagonal().array() += 1e-6 * scale;
      const VectorXd slope = added.transpose() * score;
      const double statistic = slope.dot(inner.llt().solve(slope));
      const double freedom = static_cast<double>(block.size());
      const double excess = (statistic - freedom) / std::sqrt(2 * freedom);
      if (excess > kLeastExcess) found.push_back({excess, block});
    }
  std::stable_sort(found.begin(), found.end(),
                   [](const Candidate& p, const Candidate& q) { return p.excess > q.excess; });
  if (found.size() > most) found.resize(most);
  for (const Candidate& candidate : found) AddBlock(fit, candidate.block);
}

// What bends where several things come together, as a limit of height that is the product of what
// friction, speed and direction do to it. Of the axes that matter most, what the mode's eta is as a
// function of each becomes one more function of that axis, and the products of these, of two to
// four axes, one coefficient each, are added.
void Fit::AddProductsOfWholes(int mode) {
  ModeFit& fit = *fits_[mode];
  struct Whole {
    double spread;
    std::size_t axis;
    VectorXd coefficients;
  };
  std::vector<Whole> wholes;
  Index column = 1;
  for (const RateBlock& block : fit.blocks) {
    const Index size = static_cast<Index>(block.size());
    const VectorXd of = fit.coefficients.segment(column, size);
    const double spread =
        (fit.features.middleCols(column, size) * of).norm() / std::sqrt(static_cast<double>(n()));
    column += size;
    if (!block.IsProduct() && spread > kLeastSpread)
      wholes.push_back({spread, block.factors[0].axis, of / spread});
  }
  std::stable_sort(wholes.begin(), wholes.end(),
                   [](const Whole& a, const Whole& b) { return a.spread > b.spread; });
  if (wholes.size() > kMostWholes) wholes.resize(kMostWholes);
  std::vector<RateFactor> factors;
  for (const Whole& whole : wholes) {
    RateAxis& axis = kind_.axes[whole.axis];
    factors.push_back({whole.axis, axis.functions.size(), 1});
    std::vector<double> at_knots(axis.knots.size(), 0);
    for (Index k = 0; k < whole.coefficients.size(); ++k)
      for (std::size_t j = 0; j < at_knots.size(); ++j)
        at_knots[j] += whole.coefficients[k] * axis.functions[k][j];
    for (double& value : at_knots) value = RoundedTo6(value);
    axis.functions.push_back(std::move(at_knots));
  }
  for (unsigned chosen = 1; chosen < 1u << factors.size(); ++chosen) {
    if (std::popcount(chosen) < 2 || std::popcount(chosen) > 4) continue;
    RateBlock block;
    for (std::size_t w = 0; w < factors.size(); ++w)
      if (chosen >> w & 1) block.factors.push_back(factors[w]);
    AddBlock(fit, block);
  }
}

void Fit::Run() {
  Begin();
  const auto turns = [&](int count, bool move_penalties) {
    for (int t = 0; t < count; ++t) {
      for (int m = 0; m < kNumFailureModes; ++m)
        if (fits_[m]) Turn(m, move_penalties);
      SetConstants();
    }
  };
  turns(3, false);
  turns(10, true);
  for (int round = 0; round < kProductRounds; ++round) {
    for (int m = 0; m < kNumFailureModes; ++m)
      if (fits_[m] && kind_.modes[m].events >= kEventsForProducts) AddProducts(m, kMostProducts);
    turns(10, true);
  }
  for (int m = 0; m < kNumFailureModes; ++m)
    if (fits_[m] && kind_.modes[m].events >= kEventsForProducts) AddProductsOfWholes(m);
  turns(15, true);
  turns(6, false);
}

// The inverse covariance of the coefficients of all fitted modes, one mode's behind the other's.
MatrixXd Fit::InverseCovariance() const {
  Index size = 0;
  for (const auto& fit : fits_)
    if (fit) size += fit->coefficients.size();
  MatrixXd inverse = MatrixXd::Zero(size, size);
  Index row = 0;
  for (int m = 0; m < kNumFailureModes; ++m) {
    if (!fits_[m]) continue;
    const ModeFit& fit = *fits_[m];
    const Index p = fit.coefficients.size();
    VectorXd score, information;
    likelihood_.ScoreAndInformation(m, score, information);
    const MatrixXd of_data = Weighed(fit.features, information);
    VectorXd penalty = PenaltyOf(fit);
    for (const Group& group : fit.groups) {
      const double known = of_data.diagonal().segment(group.begin, group.size).mean();
      penalty.segment(group.begin, group.size)
          .setConstant(std::min(group.penalty, kStiffest * known));
    }
    inverse.block(row, row, p, p) = of_data;
    inverse.block(row, row, p, p).diagonal() += penalty;
    Index column = 0;
    for (int k = 0; k < m; ++k) {
      if (!fits_[k]) continue;
      const MatrixXd& others = fits_[k]->features;
      inverse.block(row, column, p, others.cols()) =
          fit.features.transpose() * (likelihood_.SharedInformation(m, k).asDiagonal() * others);
      column += others.cols();
    }
    row += p;
  }
  return inverse.selfadjointView<Eigen::Lower>();
}

// Of the probability that a meeting fails by the coefficients, by row.
MatrixXd Fit::FailureSlopes() const {
  Index size = 0;
  for (const auto& fit : fits_)
    if (fit) size += fit->coefficients.size();
  MatrixXd slopes(n(), size);
  Index column = 0;
  for (int m = 0; m < kNumFailureModes; ++m) {
    if (!fits_[m]) continue;
    const VectorXd by_eta =
        (-likelihood_.total()).array().exp() * (1 - (-likelihood_.rates().col(m)).array().exp());
    const Index p = fits_[m]->coefficients.size();
    slopes.middleCols(column, p) = by_eta.asDiagonal() * fits_[m]->features;
    column += p;
  }
  return slopes;
}

std::vector<double> Rounded(const VectorXd& from) {
  std::vector<double> to(from.data(), from.data() + from.size());
  for (double& value : to) value = RoundedTo6(value);
  return to;
}

void Fit::Write(std::string_view name) {
  const MatrixXd deviations = MemberDeviations(InverseCovariance(), FailureSlopes(), name);

  Index row = 0;
  for (int m = 0; m < kNumFailureModes; ++m) {
    ModeRates& mode = kind_.modes[m];
    if (!fits_[m]) {
      if (mode.events > 0)
        SetConstantRate(likelihood_.Exposure(), mode.events / likelihood_.Exposure(),
                        std::string(name) + "." + std::string(Name(FailureMode(m))), mode);
      continue;
    }
    const ModeFit& fit = *fits_[m];
    const Index p = fit.coefficients.size();
    mode.blocks = fit.blocks;
    mode.coefficients = Rounded(fit.coefficients);
    for (Index r = 0; r < deviations.cols(); ++r)
      mode.members.push_back(Rounded(fit.coefficients + deviations.col(r).segment(row, p)));
    row += p;
  }
}

}  // namespace

void FitKindRates(const std::vector<RateRow>& rows, std::string_view name, KindRates& kind) {
  Fit fit(rows, kind);
  fit.Run();
  fit.Write(name);
}

}  // namespace floorproof
