// SPDX-License-Identifier: Apache-2.0
#include "env/audit/gathering.h"

#include <cmath>

namespace floorproof {

std::optional<double> Gathering::Efficiency() const {
  if (dirty + clean == 0) return std::nullopt;
  return static_cast<double>(dirty) / (dirty + clean);
}

Gathering Gather(std::span<const int> dirt_counts, int dirty_above) {
  Gathering gathering;
  for (const int count : dirt_counts) ++(count > dirty_above ? gathering.dirty : gathering.clean);
  return gathering;
}

SpaceScore ScoreOfSpace(std::span<const double> sample_scores) {
  SpaceScore space;
  space.samples = static_cast<int>(sample_scores.size());
  if (sample_scores.empty()) return space;
  const double n = space.samples;
  double sum = 0, squares = 0;
  for (const double score : sample_scores) sum += score;
  space.mean = sum / n;
  for (const double score : sample_scores) squares += (score - *space.mean) * (score - *space.mean);
  if (space.samples > 1) space.standard_error = std::sqrt(squares / (n - 1) / n);
  return space;
}

}  // namespace floorproof
