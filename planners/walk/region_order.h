// SPDX-License-Identifier: Apache-2.0
// The order in which to cover the regions of a floor.
#pragma once

#include <vector>

#include "planners/walk/walk_graph.h"

namespace floorproof {

// The regions that hold required cells (`required`: by cell), in an order with few crossings of
// terrain. The start's region comes first. The region of `end` (-1: the walk ends anywhere) comes
// last, unless it is the start's.
std::vector<int> OrderRegions(const WalkGraph& graph, const std::vector<std::uint8_t>& required,
                              int start, int end);

}  // namespace floorproof
