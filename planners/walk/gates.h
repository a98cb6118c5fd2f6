// SPDX-License-Identifier: Apache-2.0
// Where a walk comes into the regions of a floor and leaves them.
#pragma once

#include <vector>

#include "planners/walk/walk_graph.h"

namespace floorproof {

struct Gates {
  int entry = -1, exit = -1;  // cells; the same where a region has but one; exit -1: anywhere
};

// By region. From `start` on, the cheapest way leads from each of `regions` to the next, between
// cells of `core` (by cell); out of the last one at `end` (-1: anywhere). Regions that are not in
// the list have none.
std::vector<Gates> FindGates(const WalkGraph& graph, const std::vector<std::uint8_t>& core,
                             const std::vector<int>& regions, int start, int end);

}  // namespace floorproof
