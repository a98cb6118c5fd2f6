// SPDX-License-Identifier: Apache-2.0
// Short lines over the patches of ground that other lines leave uncovered.
#pragma once

#include "planners/lines/shortest_paths.h"
#include "planners/lines/swept.h"

namespace floorproof {

// Lines over the connected patches of open ground of at least `min_cells`, each added to `swept`.
std::vector<Polyline> LinesOverUncoveredPatches(const Floor& floor, const ShortestPaths& paths,
                                                double min_cells, Swept& swept);

}  // namespace floorproof
