// SPDX-License-Identifier: Apache-2.0
#include "planners/online/nearest_uncovered.h"

namespace floorproof {

std::vector<Cell> NearestUncovered::PathFrom(Cell from, const RobotCells& cells) {
  const int width = cells.frame().width;
  const auto number = [width](Cell c) { return c.iy * width + c.ix; };
  const auto cell = [width](int node) { return Cell{node % width, node / width}; };
  search_.Begin();
  search_.Reach(number(from), 0);
  const int found = search_.Run([&](const auto& at) { return cells.IsUncovered(cell(at.node)); },
                                [&](const auto& at, const auto& reach) {
                                  const Cell here = cell(at.node);
                                  for (std::size_t k = 0; k < kSteps.size(); ++k)
                                    if (cells.MayStep(here, k))
                                      reach(number(here + kSteps[k]),
                                            at.cost + (k % 2 == 0 ? kStraight : kDiagonal));
                                });
  std::vector<Cell> path;
  if (found == search_.kNone) return path;
  for (const int node : search_.PathTo(found)) path.push_back(cell(node));
  path.erase(path.begin());
  return path;
}

}  // namespace floorproof
