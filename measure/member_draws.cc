// SPDX-License-Identifier: Apache-2.0
// In coordinates in which the posterior is round, members are sums over orthogonal directions, each
// with its own pattern of signs over the members. Patterns are the columns of Hadamard's matrix but
// the first: of mean 0, and orthogonal, so that the directions do not mix. There is one less than
// members. Half of them go to the directions along which predictions vary most (eigenvectors), half
// to random directions across them, made longer, as there are more of these than patterns.
#include "measure/member_draws.h"

#include <array>
#include <bit>
#include <cmath>
#include <numeric>

#include "base/streams.h"
#include "planners/risk/rate_model.h"
#include "stats/dense_solvers.h"

namespace floorproof {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr Index kPatterns = kRateMembers - 1, kExact = 8;
static_assert(std::has_single_bit(kRateMembers));

double Sign(Index pattern, Index member) {
  return std::popcount(static_cast<unsigned>((pattern + 1) & member)) % 2 == 0 ? 1 : -1;
}

std::uint64_t SeedOf(const MatrixXd& data) {
  std::uint64_t seed = 0;
  for (const double value : data.diagonal()) seed = seed * 31 + std::bit_cast<std::uint64_t>(value);
  return seed;
}

}  // namespace

MatrixXd MemberDeviations(const MatrixXd& inverse_covariance, const MatrixXd& slopes,
                          std::string_view name) {
  const Index p = inverse_covariance.rows();
  if (p == 0) return MatrixXd(0, kRateMembers);
  const Cholesky root(inverse_covariance);
  // Slopes in the round coordinates u, where the deviation is L^-T u.
  const MatrixXd round = root.SolveLower(slopes.transpose());
  MatrixXd spread = MatrixXd::Zero(p, p);
  spread.selfadjointView<Eigen::Lower>().rankUpdate(round);
  const SymmetricEigen eigen = EigenOfSymmetric(spread);

  const Index exact = p <= kPatterns ? p : kExact;
  MatrixXd directions = MatrixXd::Zero(p, std::min(p, kPatterns));
  directions.leftCols(exact) = eigen.vectors.rightCols(exact) * std::sqrt(kPatterns);
  if (p > exact) {
    const Index random = kPatterns - exact, others = p - exact;
    Stream stream(SeedOf(inverse_covariance), 0, name);
    MatrixXd drawn(others, random);
    for (Index c = 0; c < random; ++c)
      for (Index r = 0; r < others; ++r) drawn(r, c) = stream.Normal();
    const Index across = std::min(random, others);
    const MatrixXd orthogonal = OrthonormalBasis(drawn.leftCols(across), across);
    const double longer = std::sqrt(static_cast<double>(kPatterns) * static_cast<double>(others) /
                                    static_cast<double>(across));
    directions.middleCols(exact, across) = eigen.vectors.leftCols(others) * orthogonal * longer;
  }
  // The first directions of other posteriors have the same patterns: so members are shuffled.
  Stream shuffle(0, 1, name);
  std::array<Index, kRateMembers> place;
  std::iota(place.begin(), place.end(), 0);
  for (std::size_t r = kRateMembers - 1; r > 0; --r)
    std::swap(place[r], place[shuffle.Below(r + 1)]);
  MatrixXd patterns(directions.cols(), kRateMembers);
  for (Index d = 0; d < patterns.rows(); ++d)
    for (Index r = 0; r < patterns.cols(); ++r)
      patterns(d, r) = Sign(d, place[r]) / std::sqrt(kRateMembers);
  return root.SolveLowerTransposed(directions * patterns);
}

}  // namespace floorproof
