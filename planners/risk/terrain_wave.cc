// SPDX-License-Identifier: Apache-2.0
#include "planners/risk/terrain_wave.h"

#include <algorithm>
#include <vector>

#include "planners/search/grid_paths.h"

namespace floorproof {
namespace {

// Closed terrain from cells that the wave has reached to one that it has not, of the least sum of
// RF; empty: there is none.
std::vector<Cell> LeastCrossing(const RiskMap& risk, const Wave& wave,
                                const Grid<std::uint8_t>& open) {
  const auto borders = [&](Cell c, bool reached) {
    return std::ranges::any_of(kSideSteps, [&](Cell step) {
      const Cell next = c + step;
      return open.Inside(next) && open(next) && wave.Reaches(next) == reached;
    });
  };
  Grid<std::uint8_t> closed_terrain(open.width, open.height);
  std::vector<Cell> met;
  for (std::size_t i = 0; i < open.cells.size(); ++i) {
    closed_terrain.cells[i] = risk.grid.contents.cells[i].terrain() && !open.cells[i];
    const Cell cell = CellAt(open, i);
    if (closed_terrain.cells[i] && borders(cell, true)) met.push_back(cell);
  }
  return LeastCostPath(
      closed_terrain, met, [&](Cell c) { return risk.rf(c); },
      [&](Cell c) { return borders(c, false); });
}

}  // namespace

Grid<double> WaveOverTerrain(const RiskMap& risk, Cell end, Grid<std::uint8_t>& open) {
  Wave wave(open, end);
  for (;;) {
    const std::vector<Cell> crossing = LeastCrossing(risk, wave, open);
    if (crossing.empty()) return wave.Scores();
    for (const Cell cell : crossing) open(cell) = 1;
    wave.GoOnThrough(crossing);
  }
}

}  // namespace floorproof
