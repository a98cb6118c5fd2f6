// SPDX-License-Identifier: Apache-2.0
// Paths from cell to cell, each step to one of the four neighbours.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "planners/search/best_first.h"
#include "planners/search/neighbours.h"

namespace floorproof {

// The path over open cells from one of `from` to the first cell that is a goal, of the least sum of
// `cost` (>= 0) over its cells, both ends included; empty: there is none.
std::vector<Cell> LeastCostPath(const Grid<std::uint8_t>& open, const std::vector<Cell>& from,
                                const std::function<double(Cell)>& cost,
                                const std::function<bool(Cell)>& goal);

// Steps to each cell of `open` from `from`; -1: out of reach, or not open.
Grid<std::int32_t> StepsFrom(const Grid<std::uint8_t>& open, Cell from);

// Shortest paths over a floor of cells; their memory is reused between searches.
class GridPaths {
 public:
  explicit GridPaths(const Grid<std::uint8_t>& open);  // outlives it

  // The shortest path over open cells from a to b, both included; empty: there is none. A* with the
  // Manhattan distance.
  std::vector<Cell> Shortest(Cell a, Cell b);
  // The FMEA paper's Algorithm 3. It takes the nearest square ring around `from` (the cells at one
  // Chebyshev distance) that holds a cell which is a goal, and the shortest path to such a cell of
  // that ring. A* with the distance to the ring. Both ends included; empty: none can be reached.
  std::vector<Cell> ToNearestRing(Cell from, const std::function<bool(Cell)>& goal);

 private:
  template <class Ahead, class Goal>
  std::vector<Cell> Search(Cell from, const Ahead& ahead, const Goal& goal);

  const Grid<std::uint8_t>& open_;
  BestFirstSearch<std::int32_t, HeapFrontier<std::int32_t, Ties::kFirstCome>> search_;
};

}  // namespace floorproof
