// SPDX-License-Identifier: Apache-2.0
// Portals: the cells by which a walk enters the regions of a floor and leaves them.
#pragma once

#include <vector>

#include "planners/walk/walk_graph.h"

namespace floorproof {

// Of one region. Cells; the same one twice where the region has only one. exit -1: anywhere.
struct Portals {
  int entry = -1, exit = -1;
};

// The portals by region. The walk goes from `start` through `regions` in their order and leaves
// each for the next where that costs least, between cells of `core` (by cell). It leaves the last
// one at `end` (-1: anywhere). Regions that are not in the list have no portals.
std::vector<Portals> FindPortals(const WalkGraph& graph, const std::vector<std::uint8_t>& core,
                                 const std::vector<int>& regions, int start, int end);

}  // namespace floorproof
