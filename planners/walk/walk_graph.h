// SPDX-License-Identifier: Apache-2.0
// The floor of a covering walk as a graph of cells.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "planners/walk/cover_walk.h"

namespace floorproof {

// Cells are numbered row by row. A border of closed cells is added, so that each cell of the floor
// has four neighbours. A region is a connected set of open cells that are all terrain, or all not.
struct WalkGraph {
  static constexpr std::int64_t kStep = 1 << 16;  // the mean weight of a required cell

  WalkGraph(const CoverWalkProblem& problem, const CoverWalkOptions& options);

  std::size_t size() const { return region.size(); }
  int At(Cell c) const { return (c.iy + 1) * stride + c.ix + 1; }
  Cell CellAt(int at) const { return {at % stride - 1, at / stride - 1}; }
  std::array<int, 4> Neighbours(int at) const { return {at + 1, at + stride, at - 1, at - stride}; }
  // What a step costs: the visit of `to`, and half a crossing where the kind of floor changes.
  std::int64_t StepCost(int from, int to) const {
    const auto a = static_cast<std::size_t>(from), b = static_cast<std::size_t>(to);
    return weight[b] + (terrain[a] != terrain[b] ? half_crossing : 0);
  }

  int stride = 0;
  std::vector<std::int32_t> region;        // by cell: connected open cells of one kind; -1: closed
  std::vector<std::uint8_t> terrain;       // by cell
  std::vector<std::int64_t> weight;        // by cell: of a visit
  std::vector<std::vector<int>> adjacent;  // by region: the regions beside it, in order
  std::int64_t least_weight = 0;
  std::int64_t half_crossing = 0;  // more than any way without a crossing
};

}  // namespace floorproof
