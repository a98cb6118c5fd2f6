// SPDX-License-Identifier: Apache-2.0
// The order in which to cover the regions of a floor.
#pragma once

#include <vector>

#include "planners/walk/walk_graph.h"

namespace floorproof {

// The regions that hold wanted cells (`wanted`: by cell), in an order with few crossings of
// terrain: the start's first; the end's (-1: ends anywhere) last, unless it is the start's.
std::vector<int> OrderRegions(const WalkGraph& graph, const std::vector<std::uint8_t>& wanted,
                              int start, int end);

}  // namespace floorproof
