// SPDX-License-Identifier: Apache-2.0
#include "planners/lines/relax.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/planners/floors.h"

namespace floorproof {
namespace {

// 5 m x 4 m with a pillar of 0.4 m at its middle; poses from 0.2 m off the walls.
HazardMap HallWithPillar() {
  HazardMap map = testing::EmptyFloor(100, 80, 0.05);
  for (int iy = 36; iy < 44; ++iy)
    for (int ix = 46; ix < 54; ++ix) map.occupancy(ix, iy) = CellState::kOccupied;
  return map;
}

Floor OfDisc(const HazardMap& map, const Vec2& start, double overlap = 0) {
  const RobotSpec robot = testing::DiscRobot(0.2, 0.3);
  return CropFloor(ComputeSweepArea(map, robot.clear, robot.tool, 0.01, start), robot.clear,
                   robot.tool, 0.3, overlap);
}

// Rows along x at the given heights; those of the middle end before the pillar.
Polyline Rows(const Floor& floor, const std::vector<double>& ys_m) {
  Polyline path;
  for (std::size_t i = 0; i < ys_m.size(); ++i) {
    const double end_m = ys_m[i] > 1.5 && ys_m[i] < 2.5 ? 2.0 : 4.775;
    const Vec2 a = floor.ToCells(Vec2(0.225, ys_m[i])), b = floor.ToCells(Vec2(end_m, ys_m[i]));
    path.push_back(i % 2 ? b : a);
    path.push_back(i % 2 ? a : b);
  }
  return path;
}

struct Outcome {
  Polyline path;
  double before, after;  // cells swept
};

Outcome Relaxed(const Floor& floor, Polyline path, double goal_share, double worth) {
  Swept swept(floor), again(floor);
  swept.Add(path);
  const double before = swept.swept_cells();
  Relax(floor, {goal_share * floor.ground_cells, worth, 1, 0.5}, path, swept);
  again.Add(path);
  EXPECT_EQ(swept.swept_cells(), again.swept_cells()) << "its books are wrong";
  return {path, before, again.swept_cells()};
}

TEST(Exchange, WonIsWhatAnExchangeChanges) {
  const HazardMap map = HallWithPillar();
  Shape2 square{Shape2::Kind::kFootprint, 0.15, {}};
  square.footprint_B = {{-0.15, -0.15}, {0.15, -0.15}, {0.15, 0.15}, {-0.15, 0.15}};
  const SweepArea area = ComputeSweepArea(map, square, square, 0.01, {1, 1});
  std::mt19937 random(7);
  const auto anywhere = [&random](const Floor& floor) {
    const auto share = [&random] { return static_cast<double>(random() % 1000) / 1000; };
    const double x = share() * floor.frame.width, y = share() * floor.frame.height;
    return Vec2(x, y);
  };
  for (const Floor& floor :
       {OfDisc(map, {1, 1}), OfDisc(map, {1, 1}, 0.2), CropFloor(area, square, square, 0.3, 0.2)}) {
    Swept swept(floor);
    for (int k = 0; k < 20; ++k) swept.Add(anywhere(floor), anywhere(floor));
    for (std::size_t legs = 1; legs <= Swept::Exchange::kMaxLegs; ++legs)
      for (int k = 0; k < 30; ++k) {
        Polyline old, fresh;
        for (std::size_t i = 0; i <= legs; ++i) old.push_back(anywhere(floor));
        for (const Vec2& p : old)
          fresh.push_back(k % 2 ? Vec2(p + Vec2(0.7, -0.4)) : anywhere(floor));
        swept.Add(old);
        Swept::Exchange exchange(swept);
        exchange.Begin(old);
        const int won = exchange.Won(fresh);
        const double before = swept.swept_cells();
        swept.Remove(old);
        swept.Add(fresh);
        EXPECT_EQ(won, swept.swept_cells() - before) << legs << " legs, " << k;
      }
  }
}

TEST(Relax, ARowSlidesOffItsNeighbourOntoOpenGround) {
  const Floor floor = OfDisc(HallWithPillar(), {1, 1});
  const Outcome out = Relaxed(floor, Rows(floor, {0.3, 0.4}), 0, 0.5);
  // They lie 0.1 m apart: apart by the tool's width, the second sweeps 0.2 m more, 4.5 m long.
  EXPECT_GT(out.after - out.before, 0.9 * 0.2 * 4.5 / (0.05 * 0.05));
}

TEST(Relax, ALinkBetweenRowsDrawsBackWhereTheRestIsSwept) {
  const Floor floor = OfDisc(HallWithPillar(), {1, 1});
  Polyline path = Rows(floor, {0.3, 0.6, 0.9});
  const double link_x = path[1].x();
  ASSERT_EQ(path[2].x(), link_x);
  // A lane across the end of the rows.
  path.push_back(floor.ToCells(Vec2(4.775, 3.0)));
  path.push_back(floor.ToCells(Vec2(4.775, 0.225)));
  const Outcome out = Relaxed(floor, path, 0, 0.5);
  for (const std::size_t i : {1u, 2u}) {
    EXPECT_LT(out.path[i].x(), link_x - floor.ToCells(0.1)) << i;
    EXPECT_GT(out.path[i].x(), link_x - floor.ToCells(0.5)) << "the lane does not sweep so far";
  }
  EXPECT_GT(out.after, 0.98 * out.before);
}

// What shortens the path most would be to draw the rows' far ends together.
TEST(Relax, LongRowsKeepTheirDirection) {
  const Floor floor = OfDisc(HallWithPillar(), {1, 1});
  const Polyline rows = Rows(floor, {0.3, 0.55, 0.9, 1.05, 1.4});
  const Outcome out = Relaxed(floor, rows, 0, 0.8);
  ASSERT_NE(out.path, rows);
  for (std::size_t i = 1; i < rows.size(); i += 2)
    EXPECT_NEAR(out.path[i].y(), out.path[i - 1].y(), 0.5) << i;
}

TEST(Relax, NeverLeavesLessThanTheGoal) {
  const Floor floor = OfDisc(HallWithPillar(), {1, 1});
  const Polyline rows =
      Rows(floor, {0.225, 0.5, 0.75, 1.05, 1.35, 1.6, 1.9, 2.2, 2.6, 2.9, 3.2, 3.5, 3.775});
  const Outcome free = Relaxed(floor, rows, 0, 3);
  const double goal = 0.98 * free.before / floor.ground_cells;
  const Outcome held = Relaxed(floor, rows, goal, 3);
  // At such a price all ground is for sale: only the goal holds it.
  EXPECT_LT(free.after, 0.9 * goal * floor.ground_cells);
  EXPECT_GE(held.after, goal * floor.ground_cells);
  EXPECT_LT(PolylineLength(held.path), PolylineLength(rows));
}

TEST(Relax, KeepsTheStartTheNumberOfPointsAndOffTheWalls) {
  const Floor floor = OfDisc(HallWithPillar(), {1, 1});
  // Round the pillar, with a corner to spare on each side.
  Polyline path;
  for (const Vec2& p :
       {Vec2(1.5, 1.3), Vec2(3.5, 1.3), Vec2(3.5, 2.7), Vec2(1.5, 2.7), Vec2(1.5, 1.6)})
    path.push_back(floor.ToCells(p));
  const Outcome out = Relaxed(floor, path, 0, 3);
  EXPECT_EQ(out.path.front(), path.front());
  ASSERT_EQ(out.path.size(), path.size());
  EXPECT_LT(PolylineLength(out.path), 0.95 * PolylineLength(path));
  for (std::size_t i = 1; i < path.size(); ++i)
    EXPECT_TRUE(floor.Sees(out.path[i - 1], out.path[i])) << "leg " << i;
}

TEST(Relax, WhatHasSettledStays) {
  const Floor floor = OfDisc(HallWithPillar(), {1, 1});
  const Polyline rows = Rows(floor, {0.225, 0.5, 0.75, 1.05, 1.35, 1.9, 2.6, 3.1, 3.4});
  const Outcome once = Relaxed(floor, rows, 0, 0.5), twice = Relaxed(floor, once.path, 0, 0.5);
  const auto cost = [&](const Outcome& out) {
    return 0.5 * floor.tool_width * PolylineLength(out.path) - out.after;
  };
  EXPECT_LT(cost(once), 0.5 * floor.tool_width * PolylineLength(rows) - once.before - 100);
  EXPECT_NEAR(cost(twice), cost(once), 0.01 * floor.ground_cells);
}

TEST(Relax, AMirroredFloorIsRelaxedAsWell) {
  const HazardMap map = HallWithPillar(), mirrored = testing::Mirrored(map);
  const Floor floor = OfDisc(map, {1, 1}), other = OfDisc(mirrored, {4, 1});
  const std::vector<double> ys = {0.225, 0.5, 0.75, 1.05, 1.35, 1.9, 2.6, 3.1, 3.4};
  const Polyline rows = Rows(floor, ys);
  Polyline reflected;
  for (const Vec2& p : rows) {
    const Vec2 p_W = floor.ToWorld(p);
    reflected.push_back(other.ToCells(Vec2(5 - p_W.x(), p_W.y())));
  }
  const Outcome here = Relaxed(floor, rows, 0.5, 0.8), there = Relaxed(other, reflected, 0.5, 0.8);
  // Ties are broken one way, so the paths may differ, but not what they are worth.
  EXPECT_NEAR(here.before, there.before, 0.001 * floor.ground_cells);
  EXPECT_NEAR(here.after, there.after, 0.01 * floor.ground_cells);
  EXPECT_NEAR(PolylineLength(here.path), PolylineLength(there.path), 0.01 * PolylineLength(rows));
}

}  // namespace
}  // namespace floorproof
