// SPDX-License-Identifier: Apache-2.0
#include "stats/rare/defensive_density.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "stats/rare/subset_pilot.h"

namespace floorproof {

double LogStandardNormal(const Eigen::VectorXd& u, double width) {
  const auto d = static_cast<double>(u.size());
  return -0.5 * u.squaredNorm() / (width * width) - d * std::log(width) -
         0.5 * d * std::log(2 * std::numbers::pi);
}

// Widened along every coordinate at once the weights of a hundred would differ by orders of
// magnitude: the more there are, the less.
DefensiveDensity::DefensiveDensity(const FailureMixture& failures, Eigen::Index dimensions)
    : failures_(failures),
      dimensions_(dimensions),
      width_(1 + std::min(1.0, 2 / std::sqrt(static_cast<double>(dimensions)))) {}

DefensiveDensity::Draw DefensiveDensity::DrawFrom(Stream& stream) const {
  const double which = stream.Uniform();
  if (which < kNominal) return {NormalVector(stream, dimensions_), true};
  if (which < kNominal + kWidened) return {width_ * NormalVector(stream, dimensions_)};
  return {failures_.Draw(stream)};
}

double DefensiveDensity::Weight(const Eigen::VectorXd& u) const {
  const double nominal = LogStandardNormal(u);
  const Eigen::Vector3d parts(std::log(kNominal) + nominal,
                              std::log(kWidened) + LogStandardNormal(u, width_),
                              std::log(1 - kNominal - kWidened) + failures_.LogDensity(u));
  return std::exp(nominal - LogSumExp(parts));
}

}  // namespace floorproof
