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
  Grid<std::uint8_t> open;     // cells to step on; steps go to the four neighbours
  Grid<std::uint8_t> wanted;   // cells to visit at least once
  Grid<std::uint8_t> terrain;  // of the open cells those to be crossed as rarely as possible
  Grid<double> cost;           // > 0, of a visit: coming back to a cell pays again
  Grid<double> more_steps;     // >= 0, that a visit counts as; > 0 on terrain: straight across it
  Cell start;
  std::optional<Cell> end;  // none: wherever is best
};

// What is minimised: first crossings (maximal runs of terrain cells), then the sum over all visits
// of cost_share * cost / (mean cost of the wanted cells) + 1 - cost_share + more_steps.
struct CoverWalkOptions {
  double cost_share = 0.5;
  double effort = 1;  // of search; 1: about 15 ms for 100 cells, 0.3 s for 40,000
};

struct CoverWalk {
  std::vector<Cell> cells;  // from start to end, neighbour by neighbour; empty: cannot be done,
  std::optional<Cell> unreachable;  // because no way leads here: start, end or a wanted cell
  int crossings = 0;
};

// Deterministic; not optimal, but at 100 cells it nearly always is.
CoverWalk ShortCoverWalk(const CoverWalkProblem& problem, const CoverWalkOptions& options = {});

// No walk for the problem has less, each by itself; wanted cells are taken to be reachable.
struct CoverWalkBound {
  std::int64_t steps = 0;
  double cost = 0;
};
CoverWalkBound BoundCoverWalk(const CoverWalkProblem& problem);

}  // namespace floorproof
