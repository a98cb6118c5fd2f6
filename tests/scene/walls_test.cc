// SPDX-License-Identifier: Apache-2.0
#include "env/scene/walls.h"

#include <gtest/gtest.h>

#include "base/streams.h"

namespace floorproof {
namespace {

// Top row first, '#' occupied.
HazardMap Drawn(const std::vector<std::string>& rows, double cell_m) {
  HazardMap map;
  const int w = static_cast<int>(rows[0].size()), h = static_cast<int>(rows.size());
  map.frame = {w, h, cell_m, {}};
  map.occupancy = Grid<CellState>(w, h);
  for (int iy = 0; iy < h; ++iy)
    for (int ix = 0; ix < w; ++ix)
      if (rows[static_cast<std::size_t>(h - 1 - iy)][static_cast<std::size_t>(ix)] == '#')
        map.occupancy(ix, iy) = CellState::kOccupied;
  return map;
}

RobotSpec Disc(double radius_m) {
  RobotSpec robot;
  robot.inscribed_radius_m = robot.circumscribed_radius_m = radius_m;
  return robot;
}

bool Covered(const std::vector<Box2>& boxes, const Vec2& p) {
  for (const auto& b : boxes)
    if (p.x() > b.low.x() && p.x() < b.high.x() && p.y() > b.low.y() && p.y() < b.high.y())
      return true;
  return false;
}

TEST(Walls, RectanglesCoverEachSetCellOnceAndNoOther) {
  Stream draw(1, 0, "cells");
  Grid<std::uint8_t> set(37, 23);
  for (auto& cell : set.cells) cell = draw.Uniform() < 0.6;
  Grid<int> times(set.width, set.height);
  for (const auto& r : MaximalRectangles(set))
    for (int iy = r.iy; iy < r.iy + r.height; ++iy)
      for (int ix = r.ix; ix < r.ix + r.width; ++ix) ++times(ix, iy);
  for (std::size_t i = 0; i < set.cells.size(); ++i) EXPECT_EQ(times.cells[i], set.cells[i]);
}

TEST(Walls, AFullGridIsOneRectangle) {
  EXPECT_EQ(MaximalRectangles(Grid<std::uint8_t>(50, 40, 1)).size(), 1u);
}

TEST(Walls, ARoomHasAWallOnEachSideAndItsFloorStaysFree) {
  const HazardMap map = Drawn({"######", "#....#", "#.#..#", "#....#", "######"}, 0.5);
  const auto boxes = WallBoxes(map, Disc(0.2), {0.75, 0.75});
  for (int iy = 0; iy < 5; ++iy)
    for (int ix = 0; ix < 6; ++ix)
      EXPECT_EQ(Covered(boxes, {0.5 * ix + 0.25, 0.5 * iy + 0.25}), map.IsWall(ix, iy))
          << ix << ", " << iy;
}

TEST(Walls, WhatLiesBeyondAMapIsWall) {
  const HazardMap map = Drawn({"...", "...", "..."}, 0.5);
  const auto boxes = WallBoxes(map, Disc(0.2), {0.75, 0.75});
  EXPECT_TRUE(Covered(boxes, {-0.25, 0.7}));
  EXPECT_TRUE(Covered(boxes, {1.75, 0.7}));
  EXPECT_FALSE(Covered(boxes, {0.75, 0.7}));
}

// A second room that no door joins: nothing of its far wall is built.
TEST(Walls, WhatTheRobotCannotTouchIsLeftOut) {
  std::vector<std::string> rows(9, "#....................#");
  rows.front() = rows.back() = std::string(22, '#');
  for (auto& row : rows) row[8] = '#';
  const HazardMap map = Drawn(rows, 0.5);
  const auto boxes = WallBoxes(map, Disc(0.2), {1.25, 1.25});
  EXPECT_TRUE(Covered(boxes, {4.25, 2.25})) << "the wall between the rooms";
  EXPECT_FALSE(Covered(boxes, {10.75, 2.25})) << "the far wall of the room beyond";
}

TEST(Walls, TheInsetDrawsFacesBackFromFreeCellsOnly) {
  HazardMap map = Drawn({"####", "#..#", "####"}, 0.5);
  map.inset_m = 0.03;
  const auto boxes = WallBoxes(map, Disc(0.2), {0.75, 0.75});
  EXPECT_FALSE(Covered(boxes, {0.48, 0.75}));
  EXPECT_TRUE(Covered(boxes, {0.46, 0.75}));
  EXPECT_TRUE(Covered(boxes, {0.02, 0.75})) << "its back stays";
}

}  // namespace
}  // namespace floorproof
