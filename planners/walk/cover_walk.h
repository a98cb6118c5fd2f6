// SPDX-License-Identifier: Apache-2.0
// Short walks from cell to cell that visit all of a set of cells.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "env/geometry/grid.h"

namespace floorproof {

// All grids have the same size.
struct CoverWalkProblem {
  Grid<std::uint8_t> open;      // cells to step on; steps go to the four neighbours
  Grid<std::uint8_t> required;  // cells to visit at least once
  Grid<std::uint8_t> terrain;   // of the open cells those to be crossed as rarely as possible
  Grid<double> cost;            // > 0, of a visit: a cell that is visited again costs again
  Grid<double> more_steps;      // >= 0: a visit counts as so many steps more; > 0 on terrain makes
                                // the walk cross it straight
  Cell start;
  std::optional<Cell> end;  // none: wherever is best
};

// What is minimised: first the crossings (maximal runs of terrain cells). Then the sum over all
// visits of cost_share * cost / (mean cost of the required cells) + 1 - cost_share + more_steps.
struct CoverWalkOptions {
  double cost_share = 0.5;
  double effort = 1;  // of the search; 1: about 15 ms for 100 cells, 0.3 s for 40,000
};

struct CoverWalk {
  std::vector<Cell> cells;  // from start to end, neighbour by neighbour; empty: there is no walk
  std::optional<Cell> unreachable;  // why there is none: start, end or a required cell is cut off
  int crossings = 0;
};

// Deterministic. Not optimal, but with 100 cells it nearly always is.
CoverWalk ShortCoverWalk(const CoverWalkProblem& problem, const CoverWalkOptions& options = {});

// No walk has fewer steps, and no walk has less cost; one walk need not reach both bounds.
// Assumed: the required cells can be reached.
struct CoverWalkBound {
  std::int64_t steps = 0;
  double cost = 0;
};
CoverWalkBound BoundCoverWalk(const CoverWalkProblem& problem);

}  // namespace floorproof
