// SPDX-License-Identifier: Apache-2.0
#include "planners/lines/regions.h"

#include <gtest/gtest.h>

#include "planners/lines/rows.h"
#include "tests/planners/floors.h"

namespace floorproof {
namespace {

using testing::DiscRobot;
using testing::Draw;

Floor MakeFloor(const HazardMap& map, const Vec2& start_W) {
  const RobotSpec robot = DiscRobot(0.18, 0.3);
  return CropFloor(ComputeSweepArea(map, robot.clear, robot.tool, 0.01, start_W), robot.clear,
                   robot.tool, 0.3);
}

double DirectionAt(const Floor& floor, const Regions& regions, const Vec2& p_W) {
  const auto label = regions.label(Floor::CellAt(floor.ToCells(p_W)));
  return regions.direction_rad.at(static_cast<std::size_t>(label));
}

TEST(FindRegions, AHallIsOne) {
  const Floor floor = MakeFloor(testing::EmptyFloor(200, 120, 0.05), {1, 1});
  const Regions dut = FindRegions(floor, 9, std::nullopt);
  ASSERT_EQ(dut.direction_rad.size(), 1u);
  EXPECT_NEAR(dut.direction_rad[0], 0, 0.02);
}

TEST(FindRegions, EachArmOfACrossroadsIsSweptAlongItself) {
  const HazardMap map = Draw(R"(
    ########################
    #......................#
    #......................#
    ###########..###########
    ###########..###########
    ###########..###########
    ###########..###########
    ###########..###########
    ###########..###########
    ########################)",
                             0.8);
  const Floor floor = MakeFloor(map, {10, 6});
  const Regions dut = FindRegions(floor, 9, std::nullopt);
  EXPECT_NEAR(std::remainder(DirectionAt(floor, dut, {3, 6.3}), kPi), 0, 0.02);
  EXPECT_NEAR(DirectionAt(floor, dut, {9.6, 2.5}), kPi / 2, 0.02);
}

TEST(FindRegions, AFixedDirectionMakesOneRegion) {
  const Floor floor = MakeFloor(testing::EmptyFloor(100, 100, 0.05), {1, 1});
  const Regions dut = FindRegions(floor, 9, -0.3);
  ASSERT_EQ(dut.direction_rad.size(), 1u);
  EXPECT_NEAR(dut.direction_rad[0], kPi - 0.3, 1e-12);
}

TEST(MakeRows, RowsOfAHallFitItsWidthAndLieOnItsPoses) {
  const Floor floor = MakeFloor(testing::EmptyFloor(200, 120, 0.05), {1, 1});
  const Regions regions = FindRegions(floor, 9, 0.0);
  const std::vector<Row> rows = MakeRows(floor, regions, {6, 9}, nullptr);
  // Poses span 6 m - 0.36 m; the tool is 0.3 m wide: 20 rows sweep all, 19 nearly.
  EXPECT_NEAR(static_cast<double>(rows.size()), 19.5, 0.6);
  for (const Row& row : rows) {
    EXPECT_NEAR((row.b - row.a).norm() * 0.05, 10 - 0.36, 0.1);
    EXPECT_TRUE(floor.Sees(row.a, row.b));
  }
  EXPECT_EQ(CountCells(rows, regions), 1);
}

TEST(MakeRows, APillarMakesFourCells) {
  HazardMap map = testing::EmptyFloor(200, 120, 0.05);
  for (int iy = 50; iy < 70; ++iy)
    for (int ix = 90; ix < 110; ++ix) map.occupancy(ix, iy) = CellState::kOccupied;
  const Floor floor = MakeFloor(map, {1, 1});
  const Regions regions = FindRegions(floor, 9, 0.0);
  EXPECT_EQ(CountCells(MakeRows(floor, regions, {6, 9}, nullptr), regions), 4);
}

TEST(MakeRows, SweptGroundIsLeftOut) {
  const Floor floor = MakeFloor(testing::EmptyFloor(200, 120, 0.05), {1, 1});
  const Regions regions = FindRegions(floor, 9, 0.0);
  Swept swept(floor);
  for (double y = 0.15; y < 3; y += 0.25)
    swept.Add(floor.ToCells(Vec2(0.2, y)), floor.ToCells(Vec2(9.8, y)));
  for (const Row& row : MakeRows(floor, regions, {6, 9}, &swept))
    EXPECT_GT(floor.ToWorld(row.a).y(), 2.85);
}

}  // namespace
}  // namespace floorproof
