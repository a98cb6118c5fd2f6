// SPDX-License-Identifier: Apache-2.0
// The order in which a path transform visits cells: the FMEA paper's Algorithms 2 and 3.
#pragma once

#include <vector>

#include "planners/walk/cell_ways.h"

namespace floorproof {

struct CellTour {
  std::vector<Cell> cells;  // each a neighbour of the last
  int dead_ends = 0;  // times that all neighbours had been visited, and others but the end not
};

// From `start` always to the unvisited neighbour (T directions) of the highest score, of equals the
// first of up, down, right, left; from a dead end by Algorithm 3 to the nearest unvisited cell; to
// `end` when all else is visited. Every open cell must be reachable from the start.
//
// Algorithm 2 as printed may visit the end on its way and stops where the last cell happens to be.
// Its text says that the sequence "will ultimately reach the end cell after visiting all the
// cells", and counts as a dead end what leaves "non-visited cells remaining other than the end
// point": so the end is nobody's next cell until it is the last one.
CellTour TransformTour(const Grid<std::uint8_t>& open, const Grid<double>& score, Cell start,
                       Cell end);

}  // namespace floorproof
