// SPDX-License-Identifier: Apache-2.0
#include "planners/lines/floor.h"

#include <gtest/gtest.h>

#include "base/streams.h"
#include "planners/lines/swept.h"
#include "planners/lines/wall_contours.h"
#include "tests/planners/floors.h"

namespace floorproof {
namespace {

using testing::DiscRobot;
using testing::Draw;

struct Prepared {
  HazardMap map;
  SweepArea area;
  Floor floor;
};

Prepared Prepare(HazardMap map, double radius_m, double tool_width_m, const Vec2& start_W) {
  const RobotSpec robot = DiscRobot(radius_m, tool_width_m);
  Prepared p{std::move(map), {}, {}};
  p.area = ComputeSweepArea(p.map, robot.clear, robot.tool, robot.step_m, start_W);
  p.floor = CropFloor(p.area, robot.clear, robot.tool, tool_width_m);
  return p;
}

const char kRooms[] = R"(
  ##############
  #.....#......#
  #.....#......#
  #............#
  #.....#..#...#
  ##############)";

TEST(Floor, TheCropHoldsAllThatIsReachable) {
  const Prepared p =
      Prepare(Draw(kRooms, 0.5, {3, 2, 0.4}), 0.18, 0.3, Pose2{3, 2, 0.4} * Vec2(1, 1));
  EXPECT_EQ(p.floor.ground_cells, static_cast<double>(p.area.sweepable_cells));
  for (int iy = 0; iy < p.area.frame.height; ++iy)
    for (int ix = 0; ix < p.area.frame.width; ++ix) {
      if (!p.area.reachable(ix, iy)) continue;
      const Vec2 q = p.floor.ToCells(p.area.frame.Center(ix, iy));
      ASSERT_TRUE(p.floor.pose(Floor::CellAt(q)));
      ASSERT_TRUE(p.floor.Free(q));
      ASSERT_LT((p.floor.ToWorld(q) - p.area.frame.Center(ix, iy)).norm(), 1e-9);
    }
}

TEST(Floor, WhatItSeesIsClearAllTheWay) {
  const Prepared p = Prepare(Draw(kRooms, 0.5), 0.18, 0.3, {1, 1});
  Stream random(3, 0, "sight");
  int seen = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec2 a(random.Uniform(0.5, 6.5), random.Uniform(0.5, 2.5));
    const Vec2 b(random.Uniform(0.5, 6.5), random.Uniform(0.5, 2.5));
    const bool sees = p.floor.Sees(p.floor.ToCells(a), p.floor.ToCells(b));
    if (!sees) continue;
    ++seen;
    Path path(2);
    path[0].p_W = a, path[1].p_W = b;
    ASSERT_GE(testing::LeastClearance(p.map, path, 0.3), 0.18 - 0.025);
  }
  EXPECT_GT(seen, 500);
}

TEST(Swept, AgreesWithTheMeterThatJudgesPlans) {
  const Prepared p = Prepare(Draw(kRooms, 0.5), 0.18, 0.3, {1, 1});
  Stream random(4, 0, "lines");
  Swept dut(p.floor);
  CoverageMeter meter(p.area, DiscRobot(0.18, 0.3).tool);
  for (int i = 0; i < 40; ++i) {
    const Vec2 a(random.Uniform(0.5, 6.5), random.Uniform(0.5, 2.5));
    const Vec2 b = i % 5 ? Vec2(random.Uniform(0.5, 6.5), random.Uniform(0.5, 2.5)) : a;
    dut.Add(p.floor.ToCells(a), p.floor.ToCells(b));
    meter.Lift();
    meter.Add({a.x(), a.y(), 0});
    meter.Add({b.x(), b.y(), 0});
    ASSERT_NEAR(dut.share(), meter.coverage(), 1e-3) << i;
  }
}

TEST(Swept, WhatIsTakenBackWasNeverThere) {
  const Prepared p = Prepare(Draw(kRooms, 0.5), 0.18, 0.3, {1, 1});
  Stream random(5, 0, "lines");
  Swept dut(p.floor);
  const auto point = [&] {
    return p.floor.ToCells(Vec2(random.Uniform(0.5, 6.5), random.Uniform(0.5, 2.5)));
  };
  dut.Add(point(), point());
  const double before = dut.swept_cells();
  std::vector<Polyline> lines;
  for (int i = 0; i < 30; ++i) lines.push_back({point(), point(), point()});
  for (const Polyline& line : lines) dut.Add(line);
  EXPECT_GT(dut.swept_cells(), before);
  for (Polyline line : lines) {
    std::reverse(line.begin(), line.end());
    dut.Remove(line);
  }
  EXPECT_EQ(dut.swept_cells(), before);
}

TEST(Contours, ARoomWithAPillarHasTwoClosedOnesAndTheirLengthIsGeometry) {
  HazardMap map = testing::EmptyFloor(120, 100, 0.05);  // 6 m x 5 m, a pillar of 1 m
  for (int iy = 40; iy < 60; ++iy)
    for (int ix = 50; ix < 70; ++ix) map.occupancy(ix, iy) = CellState::kOccupied;
  const Prepared p = Prepare(std::move(map), 0.2, 0.3, {1, 1});
  const auto contours = Contours(p.floor, PoseDepth(p.floor), 0);
  ASSERT_EQ(contours.size(), 2u);
  double length_m = 0;
  for (const Polyline& ring : contours) {
    EXPECT_EQ(ring.front(), ring.back());
    for (const Vec2& q : ring) EXPECT_TRUE(p.floor.pose(Floor::CellAt(q)));
    const Polyline simple = Simplify(p.floor, ring, 0.7);
    EXPECT_LT(simple.size(), 30u);
    for (std::size_t i = 1; i < simple.size(); ++i)
      EXPECT_TRUE(p.floor.Sees(simple[i - 1], simple[i]));
    length_m += PolylineLength(simple) * 0.05;
  }
  // The rooms' rectangle drawn in by the radius, and the pillar's with rounded corners.
  EXPECT_NEAR(length_m, 2 * (6 - 0.4 + 5 - 0.4) + 4 + 2 * kPi * 0.2, 0.6);
}

TEST(OpenParts, AWallIsSweptOnceHoweverOftenItIsAskedFor) {
  const Prepared p = Prepare(Draw(kRooms, 0.5), 0.18, 0.3, {1, 1});
  Swept swept(p.floor);
  const auto walls = Contours(p.floor, PoseDepth(p.floor), 0);
  EXPECT_FALSE(OpenParts(p.floor, walls, 0.2, 3, 0.7, swept).empty());
  EXPECT_TRUE(OpenParts(p.floor, walls, 0.2, 3, 0.7, swept).empty());
}

TEST(MergeStraight, PointsOnALineGoAndCornersStay) {
  EXPECT_EQ(MergeStraight({{0, 0}, {1, 0}, {1, 0}, {2, 0}, {5, 0}, {5, 3}}).size(), 3u);
  EXPECT_EQ(MergeStraight({{0, 0}, {4, 0}, {1, 0}}).size(), 3u);  // there and back again
}

}  // namespace
}  // namespace floorproof
