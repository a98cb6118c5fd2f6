// SPDX-License-Identifier: Apache-2.0
// What a disc sweeps that reaches past obstacles.
//
// Only cells near obstacles can be hidden. A cell is in sight of some pose if it is in sight of a
// pose at the border of the poses: the straight line from it to a pose within them crosses the
// border nearer by.
#include <algorithm>
#include <cmath>
#include <limits>

#include "env/core/coverage.h"
#include "env/core/line_of_sight.h"
#include "env/geometry/distance.h"

namespace floorproof {
namespace {

// Of the set cells, those beside one that is not.
Grid<std::uint8_t> BorderOf(const Grid<std::uint8_t>& set) {
  Grid<std::uint8_t> border(set.width, set.height);
  const auto is_set = [&](int ix, int iy) { return set.Inside(ix, iy) && set(ix, iy); };
  for (int iy = 0; iy < set.height; ++iy)
    for (int ix = 0; ix < set.width; ++ix)
      border(ix, iy) = set(ix, iy) && !(is_set(ix - 1, iy) && is_set(ix + 1, iy) &&
                                        is_set(ix, iy - 1) && is_set(ix, iy + 1));
  return border;
}

Vec2 CentreOf(int ix, int iy) { return {ix + 0.5, iy + 0.5}; }

}  // namespace

void FloorRoom::SweepInSight(double radius_cells, SweepArea& area) const {
  constexpr double kThinnest = 0.5;  // cells: a wall so near the rim hides no cell's centre
  DilateDisc(area.reachable, radius_cells, area.sweepable);
  float least_m = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < clearance_m_.cells.size(); ++i)
    if (area.reachable.cells[i]) least_m = std::min(least_m, clearance_m_.cells[i]);
  const double overhang_m = radius_cells * frame_.cell_m - static_cast<double>(least_m);
  if (!(overhang_m > kThinnest * frame_.cell_m)) return;

  area.hidden = Grid<std::uint8_t>(frame_.width, frame_.height);
  const Grid<std::uint8_t> border = BorderOf(area.reachable);
  const int reach = static_cast<int>(radius_cells);
  const auto look = [&](int ix, int iy) {
    bool is_seen = area.reachable(ix, iy) != 0;
    for (int y = std::max(0, iy - reach); y <= std::min(frame_.height - 1, iy + reach); ++y)
      for (int x = std::max(0, ix - reach); x <= std::min(frame_.width - 1, ix + reach); ++x) {
        if (!border(x, y) || std::hypot(x - ix, y - iy) > radius_cells) continue;
        if (InSight(clearance_m_, frame_.cell_m, CentreOf(x, y), CentreOf(ix, iy)))
          is_seen = true;
        else
          area.hidden(ix, iy) = 1;
      }
    area.sweepable(ix, iy) = is_seen;
  };
  for (int iy = 0; iy < frame_.height; ++iy)
    for (int ix = 0; ix < frame_.width; ++ix)
      if (const auto free_m = static_cast<double>(clearance_m_(ix, iy));
          area.sweepable(ix, iy) && free_m > 0 && free_m < overhang_m + frame_.cell_m)
        look(ix, iy);
}

}  // namespace floorproof
