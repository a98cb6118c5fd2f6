// SPDX-License-Identifier: Apache-2.0
// Tour construction: a first tour over all required cells, for a local search to improve.
#pragma once

#include <vector>

#include "planners/walk/walk_graph.h"

namespace floorproof {

// Most cells of the tour are neighbours of the next one. It leads from `start` through `regions` in
// their order, at last to `end` (-1: ends anywhere). `required`: by cell, start and end included.
std::vector<int> ConstructTour(const WalkGraph& graph, const std::vector<std::uint8_t>& required,
                               int start, int end, const std::vector<int>& regions);

}  // namespace floorproof
