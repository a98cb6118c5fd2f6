// SPDX-License-Identifier: Apache-2.0
#include "planners/audit/room.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "env/geometry/distance.h"

namespace floorproof {
namespace {

// From a pose to the farthest cell of the room, in the shape's reach: a disc in the corner of a
// room leaves (sqrt(2) - 1) of its radius. And in cells, as poses lie at their middles.
constexpr double kReaches = 1.5, kCells = 1.5;

// The cells of `open` that are connected with those of `from`, by their sides.
Grid<std::uint8_t> ConnectedWith(const Grid<std::uint8_t>& from, const Grid<std::uint8_t>& open) {
  Grid<std::uint8_t> inside(open.width, open.height);
  std::vector<Cell> stack;
  const auto add = [&](int ix, int iy) {
    if (!open.Inside(ix, iy) || !open(ix, iy) || inside(ix, iy)) return;
    inside(ix, iy) = 1;
    stack.push_back({ix, iy});
  };
  for (int iy = 0; iy < open.height; ++iy)
    for (int ix = 0; ix < open.width; ++ix)
      if (from(ix, iy)) add(ix, iy);
  while (!stack.empty()) {
    const Cell c = stack.back();
    stack.pop_back();
    add(c.ix - 1, c.iy), add(c.ix + 1, c.iy), add(c.ix, c.iy - 1), add(c.ix, c.iy + 1);
  }
  return inside;
}

bool Touches(const Grid<std::uint8_t>& set, int ix, int iy) {
  for (int y = iy - 1; y <= iy + 1; ++y)
    for (int x = ix - 1; x <= ix + 1; ++x)
      if (set.Inside(x, y) && set(x, y)) return true;
  return false;
}

}  // namespace

Room MakeRoom(const HazardMap& map, const SweepArea& area, double reach_m) {
  Room room;
  room.frame = area.frame;
  const auto solid = [&area](std::size_t i) { return area.clearance_m.cells[i] <= 0; };
  const double near = kReaches * reach_m / area.frame.cell_m + kCells;
  Grid<std::uint8_t> open(area.frame.width, area.frame.height);
  DilateDisc(area.reachable, near, open);
  for (std::size_t i = 0; i < open.cells.size(); ++i)
    if (solid(i)) open.cells[i] = 0;
  room.inside = ConnectedWith(area.reachable, open);

  const double ratio = area.frame.cell_m / map.frame.cell_m;
  room.pixels = Grid<std::uint8_t>(area.frame.width, area.frame.height, kUnknownPixel);
  for (int iy = 0; iy < area.frame.height; ++iy)
    for (int ix = 0; ix < area.frame.width; ++ix) {
      std::uint8_t& pixel = room.pixels(ix, iy);
      const auto cell = [ratio](int i) { return static_cast<int>((i + 0.5) * ratio); };
      if (room.inside(ix, iy))
        pixel = kFreePixel;
      else if (Touches(room.inside, ix, iy) ||
               (solid(open.Index(ix, iy)) &&
                map.occupancy(cell(ix), cell(iy)) != CellState::kUnknown))
        pixel = kOccupiedPixel;
    }
  return room;
}

Grid<float> SensorReach(const SweepArea& area, const RobotSpec& robot) {
  Grid<float> reach(area.frame.width, area.frame.height);
  if (robot.clear.kind != Shape2::Kind::kCircle) {
    // Between cell centres a footprint is free where it is at the four centres around
    // (planners/lines/floor.cc). Where that is no part of the cell, there is its centre.
    constexpr float kCentre = 0.01F;
    const auto free = [&area](int ix, int iy) {
      return area.reachable.Inside(ix, iy) && area.reachable(ix, iy);
    };
    for (int iy = 0; iy < reach.height; ++iy)
      for (int ix = 0; ix < reach.width; ++ix) {
        if (!free(ix, iy)) continue;
        float quarters = 0;
        for (const int dx : {-1, 1})
          for (const int dy : {-1, 1})
            if (free(ix + dx, iy) && free(ix, iy + dy) && free(ix + dx, iy + dy)) ++quarters;
        reach(ix, iy) = std::max(kCentre, quarters / 4);
      }
    return reach;
  }
  const double cell_m = area.frame.cell_m;
  Grid<std::uint8_t> near(reach.width, reach.height);
  DilateDisc(area.reachable, robot.audit_sensor_x_m / cell_m + 0.5, near);
  // Along a wall the sensor gets so near to it.
  const double least_m = robot.clear.radius_m - robot.audit_sensor_x_m;
  for (std::size_t i = 0; i < reach.cells.size(); ++i) {
    const double beyond_m = static_cast<double>(area.clearance_m.cells[i]) - least_m;
    if (near.cells[i])
      reach.cells[i] = static_cast<float>(std::clamp(beyond_m / cell_m + 0.5, 0.0, 1.0));
  }
  return reach;
}

}  // namespace floorproof
