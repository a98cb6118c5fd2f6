// SPDX-License-Identifier: Apache-2.0
#include "stats/dense_solvers.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>

namespace floorproof {

using Eigen::Index;
using Eigen::Lower;
using Eigen::MatrixXd;
using Eigen::VectorXd;

SymmetricEigen EigenOfSymmetric(const MatrixXd& a) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(a);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

SymmetricEigen GeneralizedEigen(const MatrixXd& a, const MatrixXd& b) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> eigen(a, b);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

MatrixXd OrthonormalBasis(const MatrixXd& a, Index columns) {
  return a.householderQr().householderQ() * MatrixXd::Identity(a.rows(), columns);
}

Cholesky::Cholesky(const MatrixXd& a) : l_(a.llt().matrixLLT()) {}

VectorXd Cholesky::Solve(const VectorXd& b) const {
  VectorXd x = b;
  l_.triangularView<Lower>().solveInPlace(x);
  l_.triangularView<Lower>().transpose().solveInPlace(x);
  return x;
}

MatrixXd Cholesky::Solve(const MatrixXd& b) const { return SolveLowerTransposed(SolveLower(b)); }

MatrixXd Cholesky::SolveLower(const MatrixXd& b) const {
  return l_.triangularView<Lower>().solve(b);
}

MatrixXd Cholesky::SolveLowerTransposed(const MatrixXd& b) const {
  return l_.triangularView<Lower>().transpose().solve(b);
}

}  // namespace floorproof
