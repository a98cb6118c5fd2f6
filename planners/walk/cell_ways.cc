// SPDX-License-Identifier: Apache-2.0
#include "planners/walk/cell_ways.h"

#include <algorithm>
#include <cstdlib>
#include <limits>

namespace floorproof {
namespace {

struct Open {
  int estimate = 0;
  std::int64_t turn = 0;  // of equals the first come
  Cell cell;
  bool operator>(const Open& b) const {
    return estimate != b.estimate ? estimate > b.estimate : turn > b.turn;
  }
};

// From where steps began (came_by -1) to `end`.
template <class CameBy>
std::vector<Cell> WayBack(Cell end, const CameBy& came_by) {
  std::vector<Cell> way = {end};
  for (int k = came_by(end); k >= 0; k = came_by(way.back())) {
    const Cell step = kSideSteps[static_cast<std::size_t>(k)];
    way.push_back({way.back().ix - step.ix, way.back().iy - step.iy});
  }
  std::reverse(way.begin(), way.end());
  return way;
}

int Chebyshev(Cell a, Cell b) { return std::max(std::abs(a.ix - b.ix), std::abs(a.iy - b.iy)); }

// Whether the ring of that radius holds a wanted cell.
bool RingHolds(const Grid<std::uint8_t>& open, Cell at, int radius,
               const std::function<bool(Cell)>& wanted) {
  const int x0 = std::max(0, at.ix - radius), x1 = std::min(open.width - 1, at.ix + radius);
  const int y0 = std::max(0, at.iy - radius), y1 = std::min(open.height - 1, at.iy + radius);
  const auto row = [&](int y) {
    if (y < 0 || y >= open.height) return false;
    for (int x = x0; x <= x1; ++x)
      if (wanted({x, y})) return true;
    return false;
  };
  const auto column = [&](int x) {
    if (x < 0 || x >= open.width) return false;
    for (int y = y0; y <= y1; ++y)
      if (wanted({x, y})) return true;
    return false;
  };
  return row(at.iy + radius) || row(at.iy - radius) || column(at.ix + radius) ||
         column(at.ix - radius);
}

}  // namespace

std::vector<Cell> LeastSumWay(const Grid<std::uint8_t>& open, const std::vector<Cell>& from,
                              const std::function<double(Cell)>& cost,
                              const std::function<bool(Cell)>& goal) {
  Grid<double> sum(open.width, open.height, std::numeric_limits<double>::infinity());
  Grid<std::int8_t> came_by(open.width, open.height, -1);
  CellFront front;
  for (const Cell cell : from) {
    sum(cell) = cost(cell);
    front.push({sum(cell), open.Index(cell.ix, cell.iy)});
  }
  while (!front.empty()) {
    const auto [value, index] = front.top();
    front.pop();
    if (value > sum.cells[index]) continue;
    const Cell now = CellAt(open, index);
    if (goal(now)) return WayBack(now, [&](Cell c) { return came_by(c); });
    for (std::size_t k = 0; k < kSideSteps.size(); ++k) {
      const Cell next = now + kSideSteps[k];
      if (!open.Inside(next) || !open(next)) continue;
      const double through = value + cost(next);
      if (through >= sum(next)) continue;
      sum(next) = through;
      came_by(next) = static_cast<std::int8_t>(k);
      front.push({through, open.Index(next.ix, next.iy)});
    }
  }
  return {};
}

Grid<std::int32_t> StepsFrom(const Grid<std::uint8_t>& open, Cell from) {
  Grid<std::int32_t> steps(open.width, open.height, -1);
  if (!open.Inside(from) || !open(from)) return steps;
  std::vector<Cell> wave = {from};
  steps(from) = 0;
  for (std::size_t i = 0; i < wave.size(); ++i)
    for (const Cell step : kSideSteps) {
      const Cell next = wave[i] + step;
      if (!open.Inside(next) || !open(next) || steps(next) >= 0) continue;
      steps(next) = steps(wave[i]) + 1;
      wave.push_back(next);
    }
  return steps;
}

CellWays::CellWays(const Grid<std::uint8_t>& open) : open_(open), seen_(open.width, open.height) {}

// A* from `from` to the first cell that is a goal; `left` never says more than the steps left.
template <class Left, class Goal>
std::vector<Cell> CellWays::Search(Cell from, const Left& left, const Goal& goal) {
  ++search_;
  std::priority_queue<Open, std::vector<Open>, std::greater<>> queue;
  std::int64_t turn = 0;
  seen_(from) = {0, search_, -1, false};
  queue.push({left(from), turn++, from});
  while (!queue.empty()) {
    const Cell now = queue.top().cell;
    queue.pop();
    if (seen_(now).closed) continue;
    seen_(now).closed = true;
    if (goal(now)) return WayBack(now, [&](Cell c) { return seen_(c).came_by; });
    const std::int32_t steps = seen_(now).steps + 1;
    for (std::size_t k = 0; k < kSideSteps.size(); ++k) {
      const Cell next = now + kSideSteps[k];
      if (!open_.Inside(next) || !open_(next)) continue;
      Seen& seen = seen_(next);
      if (seen.search == search_ && (seen.closed || seen.steps <= steps)) continue;
      seen = {steps, search_, static_cast<std::int8_t>(k), false};
      queue.push({steps + left(next), turn++, next});
    }
  }
  return {};
}

std::vector<Cell> CellWays::Shortest(Cell a, Cell b) {
  if (!open_.Inside(a) || !open_.Inside(b) || !open_(a) || !open_(b)) return {};
  return Search(
      a, [&](Cell c) { return std::abs(c.ix - b.ix) + std::abs(c.iy - b.iy); },
      [&](Cell c) { return c == b; });
}

std::vector<Cell> CellWays::ToNearestRing(Cell from, const std::function<bool(Cell)>& wanted) {
  const int most =
      std::max({from.ix, from.iy, open_.width - 1 - from.ix, open_.height - 1 - from.iy});
  for (int radius = 1; radius <= most; ++radius) {
    if (!RingHolds(open_, from, radius, wanted)) continue;
    std::vector<Cell> way = Search(
        from, [&](Cell c) { return std::abs(radius - Chebyshev(c, from)); },
        [&](Cell c) { return Chebyshev(c, from) == radius && wanted(c); });
    if (!way.empty()) return way;
  }
  return {};
}

}  // namespace floorproof
