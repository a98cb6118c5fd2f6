// SPDX-License-Identifier: Apache-2.0
// Short walks from cell to cell that visit all of a set of cells.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "env/core/grid.h"

namespace floorproof {

// All grids have the same size.
struct CoverWalkProblem {
  Grid<std::uint8_t> open;     // cells to step on; steps go to the four neighbours
  Grid<std::uint8_t> wanted;   // cells to visit at least once
  Grid<std::uint8_t> terrain;  // of the open cells those to be crossed as rarely as possible
  Grid<double> cost;           // > 0, of a visit: coming back to a cell pays again
  Cell start;
  std::optional<Cell> end;  // none: wherever is best
};

// What is minimised: first crossings (maximal runs of terrain cells), then the sum over all visits
// of cost_share * cost / (mean cost of the wanted cells) + 1 - cost_share, and terrain_steps more
// where the cell is terrain.
struct CoverWalkOptions {
  double cost_share = 0.5;
  double terrain_steps = 1;  // > 0: straight across rather than along
  double effort = 1;         // of search; 1: about 15 ms for 100 cells, 0.3 s for 40,000
  std::uint64_t seed = 0;
};

struct CoverWalk {
  std::vector<Cell> cells;  // from start to end, neighbour by neighbour; empty: cannot be done,
  std::optional<Cell> unreachable;  // because no way leads here: start, end or a wanted cell
  int crossings = 0;
  double cost = 0;  // over all visits, the start's included
};

// `seed_walk`: another walk for the same problem, or none. The result is not worse: it has fewer
// crossings, or as many and neither more cost nor more steps. Deterministic; not optimal, but at
// 100 cells it nearly always is.
CoverWalk ShortCoverWalk(const CoverWalkProblem& problem, const CoverWalkOptions& options = {},
                         const std::vector<Cell>& seed_walk = {});

// No walk for the problem has less, each by itself; wanted cells are taken to be reachable.
struct CoverWalkBound {
  std::int64_t steps = 0;
  double cost = 0;
};
CoverWalkBound BoundCoverWalk(const CoverWalkProblem& problem);

}  // namespace floorproof
