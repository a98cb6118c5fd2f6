// SPDX-License-Identifier: Apache-2.0
#include "planners/search/grid_paths.h"

#include <algorithm>
#include <cstdlib>

namespace floorproof {
namespace {

// Calls use(neighbour) for each open one of the four.
template <class Use>
void ForOpenNeighbours(const Grid<std::uint8_t>& open, Cell cell, const Use& use) {
  for (const Cell step : kSideSteps)
    if (const Cell next = cell + step; open.Inside(next) && open(next)) use(next);
}

std::vector<Cell> CellsOf(const Grid<std::uint8_t>& grid, const std::vector<int>& path) {
  std::vector<Cell> cells;
  for (const int node : path) cells.push_back(CellAt(grid, Z(node)));
  return cells;
}

int Chebyshev(Cell a, Cell b) { return std::max(std::abs(a.ix - b.ix), std::abs(a.iy - b.iy)); }

// Whether the ring of that radius holds a goal.
bool RingHolds(const Grid<std::uint8_t>& open, Cell at, int radius,
               const std::function<bool(Cell)>& goal) {
  const int x0 = std::max(0, at.ix - radius), x1 = std::min(open.width - 1, at.ix + radius);
  const int y0 = std::max(0, at.iy - radius), y1 = std::min(open.height - 1, at.iy + radius);
  const auto row = [&](int y) {
    if (y < 0 || y >= open.height) return false;
    for (int x = x0; x <= x1; ++x)
      if (goal({x, y})) return true;
    return false;
  };
  const auto column = [&](int x) {
    if (x < 0 || x >= open.width) return false;
    for (int y = y0; y <= y1; ++y)
      if (goal({x, y})) return true;
    return false;
  };
  return row(at.iy + radius) || row(at.iy - radius) || column(at.ix + radius) ||
         column(at.ix - radius);
}

}  // namespace

std::vector<Cell> LeastCostPath(const Grid<std::uint8_t>& open, const std::vector<Cell>& from,
                                const std::function<double(Cell)>& cost,
                                const std::function<bool(Cell)>& goal) {
  BestFirstSearch<double> search(open.cells.size());
  search.Begin();
  for (const Cell cell : from) search.Reach(NumberOf(open, cell), cost(cell));
  const int end = search.Run([&](const auto& at) { return goal(CellAt(open, Z(at.node))); },
                             [&](const auto& at, const auto& reach) {
                               ForOpenNeighbours(open, CellAt(open, Z(at.node)), [&](Cell next) {
                                 reach(NumberOf(open, next), at.cost + cost(next));
                               });
                             });
  return CellsOf(open, search.PathTo(end));
}

Grid<std::int32_t> StepsFrom(const Grid<std::uint8_t>& open, Cell from) {
  Grid<std::int32_t> steps(open.width, open.height, -1);
  if (!open.Inside(from) || !open(from)) return steps;
  std::vector<Cell> queue = {from};
  steps(from) = 0;
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const Cell now = queue[i];
    ForOpenNeighbours(open, now, [&](Cell next) {
      if (steps(next) >= 0) return;
      steps(next) = steps(now) + 1;
      queue.push_back(next);
    });
  }
  return steps;
}

GridPaths::GridPaths(const Grid<std::uint8_t>& open) : open_(open), search_(open.cells.size()) {}

template <class Ahead, class Goal>
std::vector<Cell> GridPaths::Search(Cell from, const Ahead& ahead, const Goal& goal) {
  search_.Begin();
  search_.Reach(NumberOf(open_, from), 0);
  const int end = search_.Run([&](int node) { return ahead(CellAt(open_, Z(node))); },
                              [&](const auto& at) { return goal(CellAt(open_, Z(at.node))); },
                              [&](const auto& at, const auto& reach) {
                                ForOpenNeighbours(open_, CellAt(open_, Z(at.node)), [&](Cell next) {
                                  reach(NumberOf(open_, next), at.cost + 1);
                                });
                              });
  return CellsOf(open_, search_.PathTo(end));
}

std::vector<Cell> GridPaths::Shortest(Cell a, Cell b) {
  if (!open_.Inside(a) || !open_.Inside(b) || !open_(a) || !open_(b)) return {};
  return Search(
      a, [&](Cell c) { return std::abs(c.ix - b.ix) + std::abs(c.iy - b.iy); },
      [&](Cell c) { return c == b; });
}

std::vector<Cell> GridPaths::ToNearestRing(Cell from, const std::function<bool(Cell)>& goal) {
  const int farthest =
      std::max({from.ix, from.iy, open_.width - 1 - from.ix, open_.height - 1 - from.iy});
  for (int radius = 1; radius <= farthest; ++radius) {
    if (!RingHolds(open_, from, radius, goal)) continue;
    std::vector<Cell> path = Search(
        from, [&](Cell c) { return std::abs(radius - Chebyshev(c, from)); },
        [&](Cell c) { return Chebyshev(c, from) == radius && goal(c); });
    if (!path.empty()) return path;
  }
  return {};
}

}  // namespace floorproof
