// SPDX-License-Identifier: Apache-2.0
// The density that fresh draws come from: a tenth nominal, a tenth widened, the rest where failures
// were found. The nominal tenth bounds every importance weight by 10 (a defensive mixture,
// Hesterberg 1995), so that an estimate is unbiased, and its variance finite, wherever failures
// are.
#pragma once

#include <Eigen/Core>

#include "base/streams.h"
#include "stats/rare/failure_mixture.h"

namespace floorproof {

class DefensiveDensity {
 public:
  static constexpr double kNominal = 0.1, kWidened = 0.1;
  static constexpr double kMostWeight = 1 / kNominal;

  static constexpr double kMirrored = 0.25;

  // `failures` outlives it. `mirrored`: a quarter of what it draws by the failures lies where one
  // coordinate, or all, has the other sign. A robot that fails to the left often fails to the
  // right, and pilots may have lost one of the two.
  DefensiveDensity(const FailureMixture& failures, Eigen::Index dimensions, bool mirrored = false);

  struct Draw {
    Eigen::VectorXd u;
    bool nominal = false;  // it came from the nominal tenth
  };
  Draw DrawFrom(Stream& stream) const;
  // The nominal density over this one: at most kMostWeight.
  double Weight(const Eigen::VectorXd& u) const;

 private:
  double LogOfFailures(const Eigen::VectorXd& u) const;

  const FailureMixture& failures_;
  Eigen::Index dimensions_;
  bool mirrored_;
  double width_;  // of the widened tenth
};

// Of the standard normal density, widened.
double LogStandardNormal(const Eigen::VectorXd& u, double width = 1);

}  // namespace floorproof
