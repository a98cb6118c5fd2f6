// SPDX-License-Identifier: Apache-2.0
#include "env/audit/gathering.h"

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

}  // namespace floorproof
