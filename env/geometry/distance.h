// SPDX-License-Identifier: Apache-2.0
// Exact distance transforms of a grid of set cells.
#pragma once

#include <cstdint>

#include "env/geometry/grid.h"

namespace floorproof {

// Exact Euclidean distance, in cells, from each cell's centre to the nearest set cell's area (the
// square, not its centre); 0 on set cells. With `border_is_set`, everything beyond the grid counts
// as set. O(cells), after Felzenszwalb & Huttenlocher 2012.
Grid<float> DistanceToSet(const Grid<std::uint8_t>& set, bool border_is_set);

// Distance, in cells, from each cell's centre to the nearest set cell's centre (DistanceToSet
// measures to its area); infinite where nothing is set.
Grid<float> DistanceToCentres(const Grid<std::uint8_t>& set);

// Marks in `out` the cells whose centre lies within `radius` cells of a set cell's, with 1; the
// others stay as they are.
void DilateDisc(const Grid<std::uint8_t>& set, double radius, Grid<std::uint8_t>& out);

}  // namespace floorproof
