// SPDX-License-Identifier: Apache-2.0
// Parallel rows over the regions of a floor.
#pragma once

#include "planners/lines/regions.h"
#include "planners/lines/swept.h"

namespace floorproof {

struct RowOptions {
  double spacing = 1;  // most between neighbouring rows, cells
  double link = 1;     // as in FindRegions
};

struct Row {
  Vec2 a, b;
  int region = 0, line = 0;  // neighbours of one region have neighbouring lines
};

// Rows of each region in its direction, at the spacing and offset that fit it best. If `swept` is
// given, only those parts of them that still have something to sweep.
std::vector<Row> MakeRows(const Floor& floor, const Regions& regions, const RowOptions& options,
                          const Swept* swept);

// The number of cells of the boustrophedon decomposition that the rows lie in. A cell is a stack of
// rows each of which has one neighbour above and one below: it ends where a sweep line splits or
// merges (Choset & Pignon 1997).
int CountCells(const std::vector<Row>& rows, const Regions& regions);

}  // namespace floorproof
