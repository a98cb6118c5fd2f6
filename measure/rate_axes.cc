// SPDX-License-Identifier: Apache-2.0
#include "measure/rate_axes.h"

#include <algorithm>
#include <cmath>

#include "base/round.h"
#include "env/geometry/geometry.h"
#include "planners/risk/cubic_functions.h"
#include "stats/dense_solvers.h"
#include "stats/quantile.h"

namespace floorproof {
namespace {

constexpr std::size_t kKnots = 8, kPeriodicKnots = 12;
constexpr double kWidestGap_rad = kPi / 2;

bool IsPeriodic(const RateAxis& axis) {
  return axis.period > 0 && axis.upper - axis.lower == axis.period;
}

// Ascending, each once.
std::vector<double> Distinct(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

// Where the measured angles begin, and how far they reach.
void SetRange(RateAxis& axis, std::vector<double>& values) {
  if (axis.period > 0) {
    for (double& x : values) x -= axis.period * std::floor(x / axis.period);
    const std::vector<double> at = Distinct(values);
    double widest = at.front() + axis.period - at.back();
    axis.lower = at.front();
    for (std::size_t i = 1; i < at.size(); ++i)
      if (at[i] - at[i - 1] > widest) {
        widest = at[i] - at[i - 1];
        axis.lower = at[i];
      }
    if (widest <= kWidestGap_rad) {
      axis.lower = 0;
      axis.upper = axis.period;
      return;
    }
    for (double& x : values)
      if (x < axis.lower) x += axis.period;
  }
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  axis.lower = RoundedTo6(*least);
  axis.upper = RoundedTo6(*most);
  // What a drive computes is never quite the same.
  constexpr double kSame = 1e-6;  // m, rad, kg; and of the value
  if (axis.upper - axis.lower <= kSame * std::max(1.0, std::abs(axis.lower)))
    axis.lower = axis.upper = std::abs(axis.lower) <= kSame ? 0 : axis.lower;
}

std::vector<double> KnotsOf(const RateAxis& axis, std::vector<double> values) {
  std::vector<double> knots;
  if (IsPeriodic(axis)) {
    for (std::size_t j = 0; j <= kPeriodicKnots; ++j)
      knots.push_back(axis.lower + axis.period * static_cast<double>(j) / kPeriodicKnots);
    return knots;
  }
  const std::vector<double> at = Distinct(values);
  if (at.size() <= kKnots) {
    knots = at;
  } else {
    std::sort(values.begin(), values.end());
    for (std::size_t j = 0; j < kKnots; ++j)
      knots.push_back(Quantile(values, static_cast<double>(j) / (kKnots - 1)));
  }
  for (double& knot : knots) knot = RoundedTo6(knot);
  knots = Distinct(knots);
  knots.front() = axis.lower;
  knots.back() = axis.upper;
  // Values that are the same but for what a drive computes would make a function of nothing.
  constexpr double kApart = 0.01;  // of the range
  std::vector<double> apart = {knots.front()};
  for (const double knot : knots)
    if (knot - apart.back() >= kApart * (axis.upper - axis.lower)) apart.push_back(knot);
  if (apart.size() == 1)
    apart.push_back(axis.upper);
  else
    apart.back() = axis.upper;
  return apart;
}

// The integral of the squared second derivative, as a quadratic form of the values at knots.
Eigen::MatrixXd Bending(const std::vector<double>& knots, bool periodic) {
  const Eigen::MatrixXd curvatures = CubicFunctions::Curvatures(knots, periodic);
  Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(knots.size(), knots.size());
  for (std::size_t j = 0; j + 1 < knots.size(); ++j) {
    const double h = knots[j + 1] - knots[j];
    weights(j, j) += h / 3;
    weights(j + 1, j + 1) += h / 3;
    weights(j, j + 1) += h / 6;
    weights(j + 1, j) += h / 6;
  }
  return curvatures.transpose() * weights * curvatures;
}

}  // namespace

RateAxis MakeRateAxis(std::string name, bool of_hazard, std::vector<double> values, double period) {
  RateAxis axis;
  axis.name = std::move(name);
  axis.of_hazard = of_hazard;
  axis.period = RoundedTo6(period);
  SetRange(axis, values);
  if (axis.upper == axis.lower) return axis;
  axis.knots = KnotsOf(axis, values);
  const bool periodic = IsPeriodic(axis);

  // In units of the range: the functions' values at knots do not depend on it.
  std::vector<double> knots;
  for (const double x : axis.knots) knots.push_back((x - axis.lower) / (axis.upper - axis.lower));
  const Eigen::Index n = static_cast<Eigen::Index>(knots.size());
  const Eigen::Index free = periodic ? n - 1 : n;  // values that can be chosen
  Eigen::MatrixXd choose = Eigen::MatrixXd::Identity(n, free);
  if (periodic) choose(n - 1, 0) = 1;
  const CubicFunctions cardinal(knots, choose, periodic);
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(free, free);
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(free), row(free);
  for (const double x : values) {
    const double u = std::clamp((x - axis.lower) / (axis.upper - axis.lower), 0.0, 1.0);
    cardinal.At(u, {row.data(), static_cast<std::size_t>(free)});
    gram.selfadjointView<Eigen::Lower>().rankUpdate(row);
    mean += row;
  }
  gram = Eigen::MatrixXd(gram.selfadjointView<Eigen::Lower>()) / static_cast<double>(values.size());
  gram.diagonal().array() += 1e-9;
  mean /= static_cast<double>(values.size());

  // Within the functions of mean 0.
  const Eigen::MatrixXd q = OrthonormalBasis(mean, free);
  const Eigen::MatrixXd inside = q.rightCols(free - 1);
  const Eigen::MatrixXd bending =
      inside.transpose() * choose.transpose() * Bending(knots, periodic) * choose * inside;
  const SymmetricEigen eigen = GeneralizedEigen(bending, inside.transpose() * gram * inside);
  const Eigen::MatrixXd found = choose * inside * eigen.vectors;
  const Eigen::Index first_bent = periodic ? 0 : 1;
  for (Eigen::Index k = 0; k < found.cols(); ++k) {
    Eigen::VectorXd f = found.col(k);
    if (k > first_bent) {
      const double bends = eigen.values[k] / eigen.values[first_bent];
      f /= periodic ? std::pow(bends, 0.25) : std::sqrt(bends);
    }
    Eigen::Index largest;
    f.cwiseAbs().maxCoeff(&largest);
    // Its sign is chosen; the last value is a function's of its own only without a period.
    if (k == 0 && !periodic ? f[n - 1] < 0 : f[largest] < 0) f = -f;
    std::vector<double> at_knots(f.data(), f.data() + n);
    for (double& y : at_knots) y = RoundedTo6(y);
    axis.functions.push_back(std::move(at_knots));
  }
  return axis;
}

std::size_t SmoothFunctions(const RateAxis& axis) {
  if (axis.functions.empty()) return 0;
  return axis.knots.size() - (IsPeriodic(axis) ? 2 : 1);
}

std::size_t FunctionsOfProducts(const RateAxis& axis) {
  constexpr std::size_t kFew = 3, kPeriodicFew = 8;  // four waves a turn: a Mecanum robot's
  return std::min(SmoothFunctions(axis), IsPeriodic(axis) ? kPeriodicFew : kFew);
}

}  // namespace floorproof
