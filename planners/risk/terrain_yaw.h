// SPDX-License-Identifier: Apache-2.0
// Headings at which a robot that moves every way crosses terrain forward.
#pragma once

#include <vector>

#include "planners/risk/risk_map.h"

namespace floorproof {

// Quarter turns (0 to 3, from the grid's x) that the robot holds on its way to each cell of a tour;
// cells are neighbours. It begins at `first` and turns as little as it must: before it steps onto
// terrain along the other axis than its own (backwards is as good as forwards), in the last cell
// behind the terrain before where there is room, if possible one where the way bends anyway. Room
// is where the four cells around are not solid. Where there is none it crosses as it is.
std::vector<int> QuartersForwardOverTerrain(const RiskGrid& grid, const std::vector<Cell>& tour,
                                            int first);

}  // namespace floorproof
