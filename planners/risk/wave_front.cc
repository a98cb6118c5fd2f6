// SPDX-License-Identifier: Apache-2.0
#include "planners/risk/wave_front.h"

#include <algorithm>
#include <vector>

#include "planners/walk/cell_ways.h"

namespace floorproof {
namespace {

constexpr double kT = 15, kX = 20;  // section 2.3

// Closed terrain from cells that the wave has reached to one that it has not, of the least sum of
// RF; empty: there is none.
std::vector<Cell> LeastCrossing(const RiskMap& risk, const Grid<double>& wave,
                                const Grid<std::uint8_t>& open) {
  const auto borders = [&](Cell c, bool reached) {
    return std::ranges::any_of(kSideSteps, [&](Cell step) {
      const Cell next = c + step;
      return open.Inside(next) && open(next) && (wave(next) < kOutOfReach) == reached;
    });
  };
  Grid<std::uint8_t> closed_terrain(open.width, open.height);
  std::vector<Cell> met;
  for (std::size_t i = 0; i < open.cells.size(); ++i) {
    closed_terrain.cells[i] = risk.grid.cells.cells[i].terrain() && !open.cells[i];
    const Cell cell = CellAt(open, i);
    if (closed_terrain.cells[i] && borders(cell, true)) met.push_back(cell);
  }
  return LeastSumWay(
      closed_terrain, met, [&](Cell c) { return risk.rf(c); },
      [&](Cell c) { return borders(c, false); });
}

using Also = std::function<double(Cell)>;

// Lowers scores until no step lowers one; `front` holds the cells from which one may.
void Spread(const Grid<std::uint8_t>& open, const Also& also, CellFront& front,
            Grid<double>& wave) {
  const auto is_open = [&](Cell c) { return open.Inside(c) && open(c); };
  while (!front.empty()) {
    const double score = front.top().first;
    const std::size_t index = front.top().second;
    front.pop();
    if (score > wave.cells[index]) continue;
    const Cell now = CellAt(open, index);
    const auto reach = [&](Cell next, double step) {
      const double value = score + step + (also ? also(next) : 0);
      if (value >= wave(next)) return;
      wave(next) = value;
      front.push({value, open.Index(next.ix, next.iy)});
    };
    for (const Cell step : kSideSteps)
      if (is_open(now + step)) reach(now + step, kT);
    for (const Cell step : kCornerSteps)
      if (is_open(now + step) && is_open(now + Cell{step.ix, 0}) && is_open(now + Cell{0, step.iy}))
        reach(now + step, kX);
  }
}

}  // namespace

Grid<double> WaveFront(const Grid<std::uint8_t>& open, Cell end, const Also& also) {
  Grid<double> wave(open.width, open.height, kOutOfReach);
  CellFront front;
  wave(end) = 0;
  front.push({0, open.Index(end.ix, end.iy)});
  Spread(open, also, front, wave);
  return wave;
}

Grid<double> WaveOverTerrain(const RiskMap& risk, Cell end, Grid<std::uint8_t>& open) {
  Grid<double> wave = WaveFront(open, end);
  for (;;) {
    const std::vector<Cell> crossing = LeastCrossing(risk, wave, open);
    if (crossing.empty()) return wave;
    // The wave begun anew would be the same up to here: it goes on around what is opened.
    CellFront front;
    for (const Cell cell : crossing) {
      open(cell) = 1;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
          if (const Cell near = cell + Cell{dx, dy}; wave.Inside(near) && wave(near) < kOutOfReach)
            front.push({wave(near), wave.Index(near.ix, near.iy)});
    }
    Spread(open, nullptr, front, wave);
  }
}

}  // namespace floorproof
