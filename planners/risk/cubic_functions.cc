// SPDX-License-Identifier: Apache-2.0
// Between knots a cubic is given by the values and second derivatives at both ends; these make the
// first derivatives agree (de Boor, A Practical Guide to Splines (1978), chapter IV).
#include "planners/risk/cubic_functions.h"

#include <Eigen/LU>
#include <algorithm>

namespace floorproof {

Eigen::MatrixXd CubicFunctions::Curvatures(const std::vector<double>& knots, bool periodic) {
  const int n = static_cast<int>(knots.size());
  Eigen::MatrixXd left = Eigen::MatrixXd::Identity(n, n), right = Eigen::MatrixXd::Zero(n, n);
  const auto join = [&](int row, int before, int at, int after, double h, double k) {
    left(row, at) = (h + k) / 3;
    left(row, before) += h / 6;
    left(row, after) += k / 6;
    right(row, before) += 1 / h;
    right(row, at) -= 1 / h + 1 / k;
    right(row, after) += 1 / k;
  };
  for (int i = 1; i + 1 < n; ++i)
    join(i, i - 1, i, i + 1, knots[i] - knots[i - 1], knots[i + 1] - knots[i]);
  if (periodic) {
    join(0, n - 2, 0, 1, knots[n - 1] - knots[n - 2], knots[1] - knots[0]);
    left(n - 1, 0) = -1;  // the last is the first
  }
  return left.partialPivLu().solve(right);
}

CubicFunctions::CubicFunctions(std::vector<double> knots, const Eigen::MatrixXd& values,
                               bool periodic)
    : knots_(std::move(knots)),
      values_(values.transpose()),
      curvatures_((Curvatures(knots_, periodic) * values).transpose()) {}

void CubicFunctions::At(double x, std::span<double> out) const {
  const auto above = std::upper_bound(knots_.begin() + 1, knots_.end() - 1, x);
  const auto j = above - knots_.begin() - 1;
  const double h = knots_[j + 1] - knots_[j];
  const double a = (knots_[j + 1] - x) / h, b = 1 - a;
  const double c = (a * a * a - a) * h * h / 6, d = (b * b * b - b) * h * h / 6;
  for (Eigen::Index k = 0; k < values_.rows(); ++k)
    out[k] = a * values_(k, j) + b * values_(k, j + 1) + c * curvatures_(k, j) +
             d * curvatures_(k, j + 1);
}

}  // namespace floorproof
