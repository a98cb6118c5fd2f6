// SPDX-License-Identifier: Apache-2.0
// The order in which a path transform visits cells: the FMEA paper's Algorithms 2 and 3.
#pragma once

#include <vector>

#include "planners/search/grid_paths.h"

namespace floorproof {

struct CellTour {
  std::vector<Cell> cells;  // each a neighbour of the last
  int dead_ends = 0;  // times that all neighbours had been visited, and others but the end not
};

// From `start` the tour goes always to the unvisited neighbour (T directions) of the highest score;
// of equals to the first of up, down, right, left. From a dead end Algorithm 3 leads it to the
// nearest unvisited cell. It goes to `end` when all else is visited. Assumed: every open cell can
// be reached from the start.
//
// Algorithm 2 as printed may visit the end on its way, and stops where the last cell happens to be.
// But its text says that the sequence "will ultimately reach the end cell after visiting all the
// cells". And it counts as a dead end what leaves "non-visited cells remaining other than the end
// point". So here the end is not chosen as the next cell until it is the last one left.
CellTour TransformTour(const Grid<std::uint8_t>& open, const Grid<double>& score, Cell start,
                       Cell end);

}  // namespace floorproof
