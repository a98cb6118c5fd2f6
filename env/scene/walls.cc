// SPDX-License-Identifier: Apache-2.0
#include "env/scene/walls.h"

#include <algorithm>

#include "env/core/coverage.h"
#include "env/geometry/distance.h"

namespace floorproof {
namespace {

// 1 on the cells of the map, with a ring around it, that are wall and within a robot's reach of the
// floor around the start.
Grid<std::uint8_t> WallsInSight(const HazardMap& map, const RobotSpec& robot, const Vec2& start_W) {
  const Grid<std::uint8_t> floor = FloorAround(map, start_W);
  const GridFrame fine = FineFrame(map.frame);
  const int k = fine.width / map.frame.width;
  Grid<std::uint8_t> reached(fine.width, fine.height);
  for (int iy = 0; iy < fine.height; ++iy)
    for (int ix = 0; ix < fine.width; ++ix) reached(ix, iy) = floor(ix / k, iy / k);
  const Grid<float> to_reached = DistanceToSet(reached, false);
  const auto reach_cells =
      static_cast<float>((robot.circumscribed_radius_m + 0.3) / fine.cell_m + 1);

  Grid<std::uint8_t> in_sight(map.frame.width + 2, map.frame.height + 2);
  const auto near = [&](int cx, int cy) {  // any fine cell of map cell (cx, cy) within reach
    for (int iy = cy * k; iy < (cy + 1) * k; ++iy)
      for (int ix = cx * k; ix < (cx + 1) * k; ++ix)
        if (to_reached(ix, iy) <= reach_cells) return true;
    return false;
  };
  for (int cy = -1; cy <= map.frame.height; ++cy)
    for (int cx = -1; cx <= map.frame.width; ++cx)
      in_sight(cx + 1, cy + 1) =
          map.IsWall(cx, cy) &&
          near(std::clamp(cx, 0, map.frame.width - 1), std::clamp(cy, 0, map.frame.height - 1));
  return in_sight;
}

}  // namespace

Grid<std::uint8_t> FloorAround(const HazardMap& map, const Vec2& start_W) {
  Grid<std::uint8_t> free(map.frame.width, map.frame.height);
  for (int iy = 0; iy < free.height; ++iy)
    for (int ix = 0; ix < free.width; ++ix) free(ix, iy) = !map.IsWall(ix, iy);
  const Cell seed = map.frame.ToCell(start_W);
  if (!free.Inside(seed) || !free(seed)) return free;
  Grid<std::uint8_t> floor(free.width, free.height);
  std::vector<Cell> stack = {seed};
  floor(seed) = 1;
  while (!stack.empty()) {
    const Cell c = stack.back();
    stack.pop_back();
    for (const Cell n :
         {Cell{c.ix + 1, c.iy}, Cell{c.ix - 1, c.iy}, Cell{c.ix, c.iy + 1}, Cell{c.ix, c.iy - 1}}) {
      if (!free.Inside(n) || !free(n) || floor(n)) continue;
      floor(n) = 1;
      stack.push_back(n);
    }
  }
  return floor;
}

std::vector<CellRect> MaximalRectangles(const Grid<std::uint8_t>& set) {
  Grid<std::uint8_t> left = set;
  const auto row_is_set = [&left](int ix, int iy, int width) {
    if (iy >= left.height) return false;
    for (int x = ix; x < ix + width; ++x)
      if (!left(x, iy)) return false;
    return true;
  };
  const auto column_is_set = [&left](int ix, int iy, int height) {
    if (ix >= left.width) return false;
    for (int y = iy; y < iy + height; ++y)
      if (!left(ix, y)) return false;
    return true;
  };
  std::vector<CellRect> rects;
  for (int iy = 0; iy < left.height; ++iy) {
    for (int ix = 0; ix < left.width; ++ix) {
      if (!left(ix, iy)) continue;
      // Grow wide then high, and high then wide; keep the larger.
      CellRect wide{ix, iy, 1, 1}, high{ix, iy, 1, 1};
      while (column_is_set(ix + wide.width, iy, 1)) ++wide.width;
      while (row_is_set(ix, iy + wide.height, wide.width)) ++wide.height;
      while (row_is_set(ix, iy + high.height, 1)) ++high.height;
      while (column_is_set(ix + high.width, iy, high.height)) ++high.width;
      const CellRect best = wide.width * wide.height >= high.width * high.height ? wide : high;
      for (int y = best.iy; y < best.iy + best.height; ++y)
        for (int x = best.ix; x < best.ix + best.width; ++x) left(x, y) = 0;
      rects.push_back(best);
    }
  }
  return rects;
}

std::vector<Box2> WallBoxes(const HazardMap& map, const RobotSpec& robot, const Vec2& start_W) {
  const Grid<std::uint8_t> in_sight = WallsInSight(map, robot, start_W);
  const double cell = map.frame.cell_m;
  std::vector<Box2> boxes;
  for (const CellRect& r : MaximalRectangles(in_sight)) {
    const int x0 = r.ix - 1, y0 = r.iy - 1, x1 = x0 + r.width, y1 = y0 + r.height;  // map cells
    Box2 box{Vec2(x0, y0) * cell, Vec2(x1, y1) * cell};
    if (map.inset_m > 0) {
      // A face is drawn back when any cell before it is free.
      const auto free_column = [&](int x) {
        for (int y = y0; y < y1; ++y)
          if (!map.IsWall(x, y)) return true;
        return false;
      };
      const auto free_row = [&](int y) {
        for (int x = x0; x < x1; ++x)
          if (!map.IsWall(x, y)) return true;
        return false;
      };
      if (free_column(x0 - 1)) box.low.x() += map.inset_m;
      if (free_column(x1)) box.high.x() -= map.inset_m;
      if (free_row(y0 - 1)) box.low.y() += map.inset_m;
      if (free_row(y1)) box.high.y() -= map.inset_m;
    }
    boxes.push_back(box);
  }
  return boxes;
}

}  // namespace floorproof
