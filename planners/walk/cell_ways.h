// SPDX-License-Identifier: Apache-2.0
// Ways from cell to cell, each step to one of four neighbours.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

#include "env/geometry/grid.h"

namespace floorproof {

// The FMEA paper's T directions, in its order: up, down, right, left.
inline constexpr std::array<Cell, 4> kSideSteps = {Cell{0, 1}, Cell{0, -1}, Cell{1, 0},
                                                   Cell{-1, 0}};
// Its X directions: up-right, right-down, down-left, left-up.
inline constexpr std::array<Cell, 4> kCornerSteps = {Cell{1, 1}, Cell{1, -1}, Cell{-1, -1},
                                                     Cell{-1, 1}};
inline Cell operator+(Cell a, Cell b) { return {a.ix + b.ix, a.iy + b.iy}; }

template <class T>
Cell CellAt(const Grid<T>& grid, std::size_t index) {
  const auto width = static_cast<std::size_t>(grid.width);
  return {static_cast<int>(index % width), static_cast<int>(index / width)};
}

// Cells by what they are from somewhere, the least first; of equals the lower index.
using CellFront = std::priority_queue<std::pair<double, std::size_t>,
                                      std::vector<std::pair<double, std::size_t>>, std::greater<>>;

// The way over open cells from one of `from` to the first cell that is a goal, of the least sum of
// `cost` (>= 0) over its cells, both ends included; empty: there is none.
std::vector<Cell> LeastSumWay(const Grid<std::uint8_t>& open, const std::vector<Cell>& from,
                              const std::function<double(Cell)>& cost,
                              const std::function<bool(Cell)>& goal);

// Steps to each cell of `open` from `from`; -1: out of reach, or not open.
Grid<std::int32_t> StepsFrom(const Grid<std::uint8_t>& open, Cell from);

// Shortest ways over a floor of cells; its memory is reused between searches.
class CellWays {
 public:
  explicit CellWays(const Grid<std::uint8_t>& open);  // outlives it

  // The shortest way over open cells from a to b, both included; empty: there is none. A* with the
  // Manhattan distance.
  std::vector<Cell> Shortest(Cell a, Cell b);
  // The FMEA paper's Algorithm 3: the nearest square ring around `from` (cells at one Chebyshev
  // distance) that holds a cell which `wanted`, and of its cells the one with the shortest way. A*
  // with the distance to the ring. Both ends included; empty: none can be reached.
  std::vector<Cell> ToNearestRing(Cell from, const std::function<bool(Cell)>& wanted);

 private:
  template <class Left, class Goal>
  std::vector<Cell> Search(Cell from, const Left& left, const Goal& goal);

  struct Seen {
    std::int32_t steps = 0;
    std::uint32_t search = 0;  // that this is of
    std::int8_t came_by = -1;  // index of kSideSteps
    bool closed = false;
  };
  const Grid<std::uint8_t>& open_;
  Grid<Seen> seen_;
  std::uint32_t search_ = 0;
};

}  // namespace floorproof
