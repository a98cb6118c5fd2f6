// SPDX-License-Identifier: Apache-2.0
#include "stats/rare/defensive_density.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "stats/rare/subset_pilot.h"

namespace floorproof {
namespace {

// As many mirrors as there are coordinates, and one of all at once.
void Mirror(Eigen::VectorXd& u, Eigen::Index which) {
  if (which == u.size())
    u = -u;
  else
    u[which] = -u[which];
}

}  // namespace

double LogStandardNormal(const Eigen::VectorXd& u, double width) {
  const auto d = static_cast<double>(u.size());
  return -0.5 * u.squaredNorm() / (width * width) - d * std::log(width) -
         0.5 * d * std::log(2 * std::numbers::pi);
}

// Widened along every coordinate at once the weights of a hundred would differ by orders of
// magnitude: the more there are, the less.
DefensiveDensity::DefensiveDensity(const FailureMixture& failures, Eigen::Index dimensions,
                                   bool mirrored)
    : failures_(failures),
      dimensions_(dimensions),
      mirrored_(mirrored),
      width_(1 + std::min(1.0, 2 / std::sqrt(static_cast<double>(dimensions)))) {}

DefensiveDensity::Draw DefensiveDensity::DrawFrom(Stream& stream) const {
  const double which = stream.Uniform();
  if (which < kNominal) return {NormalVector(stream, dimensions_), true};
  if (which < kNominal + kWidened) return {width_ * NormalVector(stream, dimensions_)};
  Draw draw{failures_.Draw(stream)};
  if (mirrored_ && stream.Uniform() < kMirrored) {
    const auto mirrors = static_cast<double>(dimensions_ + 1);
    Mirror(draw.u, static_cast<Eigen::Index>(stream.Uniform() * mirrors));
  }
  return draw;
}

double DefensiveDensity::LogOfFailures(const Eigen::VectorXd& u) const {
  if (!mirrored_) return failures_.LogDensity(u);
  const auto mirrors = static_cast<double>(dimensions_ + 1);
  Eigen::VectorXd parts(dimensions_ + 2);
  for (Eigen::Index which = 0; which <= dimensions_; ++which) {
    Eigen::VectorXd mirrored = u;
    Mirror(mirrored, which);
    parts[which] = std::log(kMirrored / mirrors) + failures_.LogDensity(mirrored);
  }
  parts[dimensions_ + 1] = std::log(1 - kMirrored) + failures_.LogDensity(u);
  return LogSumExp(parts);
}

double DefensiveDensity::Weight(const Eigen::VectorXd& u) const {
  const double nominal = LogStandardNormal(u);
  const Eigen::Vector3d parts(std::log(kNominal) + nominal,
                              std::log(kWidened) + LogStandardNormal(u, width_),
                              std::log(1 - kNominal - kWidened) + LogOfFailures(u));
  return std::exp(nominal - LogSumExp(parts));
}

}  // namespace floorproof
