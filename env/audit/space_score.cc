// SPDX-License-Identifier: Apache-2.0
#include "env/audit/space_score.h"

#include <cmath>

#include "base/error.h"

namespace floorproof {
namespace {

double MeanOf(std::span<const double> values) {
  double total = 0;
  for (const double value : values) total += value;
  return total / static_cast<double>(values.size());
}

}  // namespace

SpaceScore ScoreOfSpace(std::span<const Stratum> strata) {
  SpaceScore space;
  double all = 0, sampled = 0, sum = 0;
  for (const Stratum& stratum : strata) {
    if (!(stratum.weight >= 0 && std::isfinite(stratum.weight)))
      throw InputError("a stratum's weight must be finite and >= 0");
    all += stratum.weight;
    space.samples += static_cast<int>(stratum.scores.size());
    if (stratum.scores.empty()) continue;
    sampled += stratum.weight;
    sum += stratum.weight * MeanOf(stratum.scores);
  }
  if (sampled == 0) return space;
  space.represented = sampled / all;
  space.mean = sum / sampled;
  // Each stratum's part of the mean's variance, and Satterthwaite's degrees of freedom.
  double variance = 0, spread = 0, freedom = 0;
  for (const Stratum& stratum : strata) {
    if (stratum.weight == 0 || stratum.scores.empty()) continue;
    if (stratum.scores.size() < 2) return space;
    const auto n = static_cast<double>(stratum.scores.size());
    const double mean = MeanOf(stratum.scores), share = stratum.weight / sampled;
    double squares = 0;
    for (const double score : stratum.scores) squares += (score - mean) * (score - mean);
    const double part = share * share * squares / (n - 1) / n;
    variance += part;
    spread += part * part / (n - 1);
    freedom += n - 1;
  }
  space.standard_error = std::sqrt(variance);
  space.degrees_of_freedom = spread > 0 ? variance * variance / spread : freedom;
  return space;
}

}  // namespace floorproof
