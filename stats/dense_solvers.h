// SPDX-License-Identifier: Apache-2.0
// Decompositions of dense matrices, as plain functions: Eigen's templates of them take longer to
// compile than all that uses them, so they are compiled once.
#pragma once

#include <Eigen/Core>

namespace floorproof {

// Eigenvalues in ascending order, and their eigenvectors as columns.
struct SymmetricEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

// Solves a v = lambda v for a symmetric matrix (its lower triangle is read); v^T v = 1.
SymmetricEigen EigenOfSymmetric(const Eigen::MatrixXd& a);

// Solves a v = lambda b v for symmetric a and positive definite b; v^T b v = 1.
SymmetricEigen GeneralizedEigen(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

// The first `columns` columns of Q in a = Q R (Householder): orthonormal, and the first a.cols() of
// them span the columns of a.
Eigen::MatrixXd OrthonormalBasis(const Eigen::MatrixXd& a, Eigen::Index columns);

// a = L L^T of a symmetric positive definite matrix, whose lower triangle is read.
class Cholesky {
 public:
  Cholesky() = default;
  explicit Cholesky(const Eigen::MatrixXd& a);

  Eigen::VectorXd Solve(const Eigen::VectorXd& b) const;  // a^-1 b
  Eigen::MatrixXd Solve(const Eigen::MatrixXd& b) const;
  Eigen::MatrixXd SolveLower(const Eigen::MatrixXd& b) const;            // L^-1 b
  Eigen::MatrixXd SolveLowerTransposed(const Eigen::MatrixXd& b) const;  // L^-T b

 private:
  Eigen::MatrixXd l_;  // above the diagonal: not read
};

}  // namespace floorproof
