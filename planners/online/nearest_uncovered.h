// SPDX-License-Identifier: Apache-2.0
// The way out where nothing is left to cover nearby: the shortest way over known floor to the
// nearest uncovered cell (Dijkstra's search, which ends there).
#pragma once

#include <vector>

#include "planners/online/robot_cells.h"
#include "planners/search/best_first.h"

namespace floorproof {

class NearestUncovered {
 public:
  explicit NearestUncovered(const GridFrame& cells)
      : search_(static_cast<std::size_t>(cells.width) * static_cast<std::size_t>(cells.height)) {}

  // From `from`, which it does not hold, to the uncovered cell; empty: none can be reached.
  // Diagonal steps count 7 where straight ones count 5. Takes time as the floor that is nearer.
  std::vector<Cell> PathFrom(Cell from, const RobotCells& cells);

 private:
  static constexpr int kStraight = 5, kDiagonal = 7;
  BestFirstSearch<int, BucketFrontier<kDiagonal + 1>> search_;
};

}  // namespace floorproof
