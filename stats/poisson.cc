// SPDX-License-Identifier: Apache-2.0
// Garwood, Biometrika 28 (1936) 437: the upper end is the rate at which k events or fewer would
// have chance alpha / 2, the lower that at which k or more would; quantiles of a gamma
// distribution. Exact for a Poisson count: events come one by one, independent, at a constant rate.
// Where one failure ends the episode the exposure stops with it, which is still that model. Events
// that come in bursts within an episode are not: their intervals are too narrow.
#include "stats/poisson.h"

#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/params.h"
#include "stats/checks.h"

namespace floorproof {

Interval GarwoodInterval(int k, double exposure, double confidence) {
  CheckCount("k", k);
  CheckConfidence(confidence);
  if (!(exposure >= 0 && std::isfinite(exposure)))
    throw InputError({}, "exposure", FormatDouble(exposure), "must be finite and >= 0");
  if (exposure == 0) return {0, std::numeric_limits<double>::infinity()};
  const double alpha = (1 - confidence) / 2;
  const double lower = k == 0 ? 0.0 : boost::math::gamma_p_inv(static_cast<double>(k), alpha);
  const double upper = boost::math::gamma_q_inv(k + 1.0, alpha);
  return {lower / exposure, upper / exposure};
}

}  // namespace floorproof
