// SPDX-License-Identifier: Apache-2.0
// Exact distance transforms of a grid of set cells.
#pragma once

#include <cstdint>

#include "env/geometry/grid.h"

namespace floorproof {

// Exact Euclidean distance, in cells, from each cell's centre to the nearest set cell's area (a
// square, not its centre); what lies beyond the grid is set when `border_is_set`. 0 on set cells.
// O(cells), after Felzenszwalb & Huttenlocher 2012.
Grid<float> DistanceToSet(const Grid<std::uint8_t>& set, bool border_is_set);

// Distance, in cells, from each cell's centre to the nearest set cell's centre (DistanceToSet
// measures to its area); infinite where nothing is set.
Grid<float> DistanceToCentres(const Grid<std::uint8_t>& set);

}  // namespace floorproof
