// SPDX-License-Identifier: Apache-2.0
// Clopper and Pearson, Biometrika 26 (1934) 404: the upper bound is the probability at which k
// events or fewer would have chance alpha, the lower one that at which k or more would. Both are
// quantiles of a beta distribution. Exact: coverage is at least nominal for every probability and
// every n (Jeffreys' interval dips below), at the price of being a little wide. Assumes independent
// episodes of one probability, and an n that was fixed beforehand: see gate.h for looking earlier.
#include "stats/binomial.h"

#include <boost/math/special_functions/beta.hpp>

#include "stats/checks.h"

namespace floorproof {
namespace {

// P(X <= k) = 1 - I_p(k + 1, n - k) = alpha.
double Upper(int k, int n, double alpha) {
  return k == n ? 1.0 : boost::math::ibetac_inv(k + 1.0, static_cast<double>(n - k), alpha);
}

// P(X >= k) = I_p(k, n - k + 1) = alpha.
double Lower(int k, int n, double alpha) {
  return k == 0 ? 0.0 : boost::math::ibeta_inv(static_cast<double>(k), n - k + 1.0, alpha);
}

}  // namespace

double ClopperPearsonUpper(int k, int n, double confidence) {
  CheckCounts(k, n);
  CheckConfidence(confidence);
  return Upper(k, n, 1 - confidence);
}

double ClopperPearsonLower(int k, int n, double confidence) {
  CheckCounts(k, n);
  CheckConfidence(confidence);
  return Lower(k, n, 1 - confidence);
}

Interval ClopperPearson(int k, int n, double confidence) {
  CheckCounts(k, n);
  CheckConfidence(confidence);
  const double alpha = (1 - confidence) / 2;
  return {Lower(k, n, alpha), Upper(k, n, alpha)};
}

}  // namespace floorproof
