// SPDX-License-Identifier: Apache-2.0
// An order of all wanted cells in which most are neighbours of the next.
#pragma once

#include <vector>

#include "planners/walk/walk_graph.h"

namespace floorproof {

// A start for path_search: from `start` through `regions` in their order, at last to `end` (-1:
// ends anywhere). `wanted`: by cell, start and end included.
std::vector<int> FirstOrder(const WalkGraph& graph, const std::vector<std::uint8_t>& wanted,
                            int start, int end, const std::vector<int>& regions);

}  // namespace floorproof
