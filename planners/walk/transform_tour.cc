// SPDX-License-Identifier: Apache-2.0
#include "planners/walk/transform_tour.h"

#include <algorithm>
#include <optional>

namespace floorproof {

CellTour TransformTour(const Grid<std::uint8_t>& open, const Grid<double>& score, Cell start,
                       Cell end) {
  CellTour tour;
  Grid<std::uint8_t> visited(open.width, open.height);
  auto left = std::ranges::count(open.cells, 1);
  const auto visit = [&](Cell cell) {
    tour.cells.push_back(cell);
    left -= !visited(cell);
    visited(cell) = 1;
  };
  // Whether the tour may go there next.
  const auto is_next = [&](Cell c) {
    return open.Inside(c) && open(c) && !visited(c) && (left == 1 || !(c == end));
  };
  GridPaths paths(open);
  visit(start);
  while (left > 0) {
    const Cell now = tour.cells.back();
    std::optional<Cell> next;
    for (const Cell step : kSideSteps) {
      const Cell cell = now + step;
      if (is_next(cell) && (!next || score(cell) > score(*next))) next = cell;
    }
    if (next) {
      visit(*next);
      continue;
    }
    tour.dead_ends += left > 1 || visited(end);
    const std::vector<Cell> path = paths.ToNearestRing(now, is_next);
    for (std::size_t i = 1; i < path.size(); ++i) visit(path[i]);
    if (path.empty()) break;
  }
  if (!(tour.cells.back() == end)) {
    const std::vector<Cell> path = paths.Shortest(tour.cells.back(), end);
    for (std::size_t i = 1; i < path.size(); ++i) visit(path[i]);
  }
  return tour;
}

}  // namespace floorproof
