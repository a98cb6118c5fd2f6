// SPDX-License-Identifier: Apache-2.0
// Probabilities of counts, computed from their definitions: the quantiles are checked against them.
#pragma once

#include <cmath>

#include "base/streams.h"

namespace floorproof {

inline double LogBinomialPmf(int k, int n, double p) {
  return std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0) + k * std::log(p) +
         (n - k) * std::log1p(-p);
}

inline double BinomialPmf(int k, int n, double p) { return std::exp(LogBinomialPmf(k, n, p)); }

inline double PoissonPmf(int k, double mean) {
  return std::exp(k * std::log(mean) - mean - std::lgamma(k + 1.0));
}

inline int DrawBinomial(Stream& stream, int n, double p) {
  int k = 0;
  for (int i = 0; i < n; ++i) k += stream.Uniform() < p;
  return k;
}

}  // namespace floorproof
