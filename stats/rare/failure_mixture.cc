// SPDX-License-Identifier: Apache-2.0
#include "stats/rare/failure_mixture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "stats/dense_solvers.h"
#include "stats/rare/subset_pilot.h"

namespace floorproof {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kTailDegrees = 4;
constexpr int kMostParts = 6;
constexpr int kStarts = 3, kMostRounds = 40;
constexpr double kEnough = 1e-4;      // log likelihood gained a point, below which a fit is done
constexpr double kLeastWidth = 0.05;  // of a part: few failures may lie on a line
constexpr double kOverlap = 0.1;      // Bhattacharyya's coefficient of parts of one region

// Places to begin from: each as likely as it is far from those before (k-means++).
std::vector<Index> Spread(const WeightedPoints& points, int n, Stream& stream) {
  const auto pick = [&](const VectorXd& share) {
    double left = stream.Uniform() * share.sum();
    for (Index i = 0; i < share.size(); ++i)
      if ((left -= share[i]) < 0) return i;
    return share.size() - 1;
  };
  std::vector<Index> chosen = {pick(points.weights)};
  VectorXd far = VectorXd::Constant(points.u.cols(), std::numeric_limits<double>::infinity());
  while (static_cast<int>(chosen.size()) < n) {
    const VectorXd squared =
        (points.u.colwise() - points.u.col(chosen.back())).colwise().squaredNorm();
    far = far.cwiseMin(squared);
    chosen.push_back(pick(far.cwiseProduct(points.weights)));
  }
  return chosen;
}

}  // namespace

double LogSumExp(const VectorXd& x) {
  const double most = x.maxCoeff();
  return std::isfinite(most) ? most + std::log((x.array() - most).exp().sum()) : most;
}

// The part that points of these shares make.
FailureMixture::Part FailureMixture::Shape(const WeightedPoints& points, const VectorXd& share) {
  const VectorXd w = points.weights.cwiseProduct(share);
  const double n = std::max(w.sum(), 1e-9);
  const auto d = static_cast<double>(points.u.rows());
  Part part;
  part.weight = n / points.weights.sum();
  part.mean = points.u * w / n;
  const MatrixXd off = points.u.colwise() - part.mean;
  // One nominal point more, so that what few points say is not taken for sure.
  const MatrixXd covariance =
      (off * w.asDiagonal() * off.transpose() + MatrixXd::Identity(off.rows(), off.rows())) /
      (n + 1);
  const SymmetricEigen axes = EigenOfSymmetric(covariance);
  const double ratio = std::sqrt(d / n);
  const double low = ratio < 1 ? (1 - ratio) * (1 - ratio) : 0, high = (1 + ratio) * (1 + ratio);
  VectorXd spread = axes.values, along = axes.vectors.transpose() * part.mean;
  for (Index i = 0; i < spread.size(); ++i) {
    const bool nominal = spread[i] >= low && spread[i] <= high;
    if (nominal) spread[i] = 1;
    spread[i] = std::max(spread[i], kLeastWidth * kLeastWidth);
    const bool centred = nominal && std::abs(along[i]) <= 3 / std::sqrt(n);
    if (centred) along[i] = 0;
    part.shaped += !centred;
  }
  part.axes = axes.vectors;
  part.mean = part.axes * along;
  part.deviation = spread.cwiseSqrt();
  return part;
}

double FailureMixture::LogNormal(const Part& part, const VectorXd& u) {
  const double squared = part.Whitened(u).squaredNorm();
  const auto d = static_cast<double>(u.size());
  return -0.5 * squared - part.LogVolume() - 0.5 * d * std::log(2 * std::numbers::pi);
}

double FailureMixture::LogStudent(const Part& part, const VectorXd& u) {
  const double squared = part.Whitened(u).squaredNorm();
  const auto d = static_cast<double>(u.size());
  return std::lgamma((kTailDegrees + d) / 2) - std::lgamma(kTailDegrees / 2) -
         0.5 * d * std::log(kTailDegrees * std::numbers::pi) - part.LogVolume() -
         0.5 * (kTailDegrees + d) * std::log1p(squared / kTailDegrees);
}

FailureMixture::Fitted FailureMixture::Fit(const WeightedPoints& points, int n, Stream& stream) {
  const Index m = points.u.cols();
  MatrixXd share = MatrixXd::Zero(m, n);
  const std::vector<Index> starts = Spread(points, n, stream);
  for (Index i = 0; i < m; ++i) {
    int nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < n; ++k) {
      const double squared =
          (points.u.col(i) - points.u.col(starts[static_cast<std::size_t>(k)])).squaredNorm();
      if (squared < least) least = squared, nearest = k;
    }
    share(i, nearest) = 1;
  }
  Fitted fitted;
  double before = -std::numeric_limits<double>::infinity();
  VectorXd logs(n);
  for (int round = 0; round < kMostRounds; ++round) {
    fitted.parts.clear();
    for (int k = 0; k < n; ++k) fitted.parts.push_back(Shape(points, share.col(k)));
    fitted.log_likelihood = 0;
    for (Index i = 0; i < m; ++i) {
      for (int k = 0; k < n; ++k) {
        const Part& part = fitted.parts[static_cast<std::size_t>(k)];
        logs[k] = std::log(part.weight) + LogNormal(part, points.u.col(i));
      }
      const double all = LogSumExp(logs);
      share.row(i) = (logs.array() - all).exp().matrix().transpose();
      fitted.log_likelihood += points.weights[i] * all;
    }
    if (fitted.log_likelihood - before < kEnough * points.weights.sum()) break;
    before = fitted.log_likelihood;
  }
  return fitted;
}

FailureMixture::FailureMixture(const WeightedPoints& points, bool noisy, Stream& stream) {
  const double n = points.weights.sum();
  const auto d = static_cast<double>(points.u.rows());
  double least = std::numeric_limits<double>::infinity();
  for (int k = 1; k <= kMostParts && (k == 1 || k * (d + 2) <= n); ++k) {
    double of_k = std::numeric_limits<double>::infinity();
    for (int start = 0; start < (k == 1 ? 1 : kStarts); ++start) {
      Fitted fitted = Fit(points, k, stream);
      double numbers = k - 1;
      for (const Part& part : fitted.parts) numbers += part.shaped * (d + 2);
      const double bic = numbers * std::log(n) - 2 * fitted.log_likelihood;
      of_k = std::min(of_k, bic);
      if (bic >= least) continue;
      least = bic;
      parts_ = std::move(fitted.parts);
    }
    if (of_k > least + 2 * d * std::log(n)) break;  // more parts would be worse still
  }
  FindRegions();
  if (noisy) AddHalfway();
}

void FailureMixture::AddHalfway() {
  const std::size_t n = parts_.size();
  for (std::size_t i = 0; i < n; ++i) {
    Part& part = parts_[i];
    part.weight /= 2;
    Part between = part;
    // Of two Gaussians: the mean of their precisions, and of precision times mean.
    const VectorXd variance = part.deviation.cwiseAbs2();
    const VectorXd along = part.axes.transpose() * part.mean;
    between.deviation = (2 * variance.array() / (1 + variance.array())).sqrt();
    between.mean = part.axes * along.cwiseQuotient((1 + variance.array()).matrix());
    parts_.push_back(std::move(between));
  }
}

void FailureMixture::FindRegions() {
  const std::size_t n = parts_.size();
  std::vector<std::size_t> leader(n);
  std::iota(leader.begin(), leader.end(), std::size_t{0});
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const MatrixXd mean_covariance = 0.5 * (parts_[a].Covariance() + parts_[b].Covariance());
      const SymmetricEigen axes = EigenOfSymmetric(mean_covariance);
      const VectorXd apart = axes.vectors.transpose() * (parts_[a].mean - parts_[b].mean);
      const double distance =
          0.125 * apart.cwiseAbs2().cwiseQuotient(axes.values).sum() +
          0.5 * (axes.values.array().log().sum() - parts_[a].LogVolume() - parts_[b].LogVolume());
      if (std::exp(-distance) < kOverlap) continue;
      const std::size_t from = leader[a], to = leader[b];
      std::ranges::replace(leader, std::max(from, to), std::min(from, to));
    }
  std::vector<int> number(n, -1);
  for (std::size_t i = 0; i < n; ++i) {
    if (number[leader[i]] < 0) number[leader[i]] = regions_++;
    parts_[i].region = number[leader[i]];
  }
}

double FailureMixture::LogDensity(const VectorXd& u) const {
  VectorXd logs(static_cast<Index>(parts_.size()));
  for (std::size_t k = 0; k < parts_.size(); ++k)
    logs[static_cast<Index>(k)] = std::log(parts_[k].weight) + LogStudent(parts_[k], u);
  return LogSumExp(logs);
}

Eigen::VectorXd FailureMixture::Draw(Stream& stream) const {
  double left = stream.Uniform();
  std::size_t k = 0;
  while (k + 1 < parts_.size() && (left -= parts_[k].weight) >= 0) ++k;
  // Chi squared of four degrees: the sum of two exponentials.
  const double chi = -2 * (std::log1p(-stream.Uniform()) + std::log1p(-stream.Uniform()));
  const VectorXd z = NormalVector(stream, parts_[k].mean.size());
  return parts_[k].mean +
         parts_[k].axes * parts_[k].deviation.cwiseProduct(z) * std::sqrt(kTailDegrees / chi);
}

int FailureMixture::RegionOf(const VectorXd& u) const {
  const auto log_share = [&](const Part& part) {
    return std::log(part.weight) + LogNormal(part, u);
  };
  return std::ranges::max_element(parts_, {}, log_share)->region;
}

}  // namespace floorproof
