// SPDX-License-Identifier: Apache-2.0
// Several cubic splines over the same knots: natural ones, or periodic ones.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace floorproof {

class CubicFunctions {
 public:
  // `values`: by knot (rows), by function. At least two knots, ascending. Periodic: the last knot
  // is the first one a period later, and has its values.
  CubicFunctions(std::vector<double> knots, const Eigen::MatrixXd& values, bool periodic);

  int functions() const { return static_cast<int>(values_.rows()); }
  // Their values at x, which lies between the first knot and the last.
  void At(double x, std::span<double> out) const;

  // The map from values at knots to second derivatives there (both by row).
  static Eigen::MatrixXd Curvatures(const std::vector<double>& knots, bool periodic);

 private:
  std::vector<double> knots_;
  Eigen::MatrixXd values_, curvatures_;  // by function (rows: what is read together), by knot
};

}  // namespace floorproof
