// SPDX-License-Identifier: Apache-2.0
#include "env/core/coverage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "base/streams.h"
#include "env/geometry/distance.h"

namespace floorproof {
namespace {

// The top row first; '#' is wall, anything else free.
HazardMap FromRows(const std::string& text, double cell_m, const Pose2& X_WG = {}) {
  std::istringstream in(text);
  std::vector<std::string> rows;
  for (std::string row; in >> row;) rows.push_back(row);
  HazardMap map;
  const int w = static_cast<int>(rows.front().size()), h = static_cast<int>(rows.size());
  map.frame = {w, h, cell_m, X_WG};
  map.occupancy = Grid<CellState>(w, h, CellState::kFree);
  for (int iy = 0; iy < h; ++iy)
    for (int ix = 0; ix < w; ++ix)
      if (rows[static_cast<std::size_t>(h - 1 - iy)][static_cast<std::size_t>(ix)] == '#')
        map.occupancy(ix, iy) = CellState::kOccupied;
  return map;
}

HazardMap EmptyFloor(int w, int h, double cell_m) {
  HazardMap map;
  map.frame = {w, h, cell_m, {}};
  map.occupancy = Grid<CellState>(w, h, CellState::kFree);
  return map;
}

Shape2 Disc(double radius_m) { return {Shape2::Kind::kCircle, radius_m, {}}; }
Shape2 Box(double length_m, double width_m) {
  return {Shape2::Kind::kFootprint, 0,
          Rectangle({-length_m / 2, -width_m / 2}, {length_m / 2, width_m / 2})};
}

double BruteForceDistance(const Grid<std::uint8_t>& set, bool border, int ix, int iy) {
  double least = std::numeric_limits<double>::infinity();
  const auto gap = [](int d) { return std::max(0.0, std::abs(d) - 0.5); };
  for (int y = -1; y <= set.height; ++y)
    for (int x = -1; x <= set.width; ++x)
      if (set.Inside(x, y) ? set(x, y) != 0 : border)
        least = std::min(least, std::hypot(gap(x - ix), gap(y - iy)));
  return least;
}

TEST(DistanceToSet, EqualsTheNearestCellsArea) {
  Stream random(7, 0, "masks");
  for (int round = 0; round < 40; ++round) {
    Grid<std::uint8_t> set(1 + static_cast<int>(random.Below(30)),
                           1 + static_cast<int>(random.Below(30)));
    const double density = random.Uniform(0, round % 2 ? 0.3 : 0.02);
    for (auto& c : set.cells) c = random.Uniform() < density;
    const bool border = round % 3 == 0;
    const Grid<float> dut = DistanceToSet(set, border);
    for (int iy = 0; iy < set.height; ++iy)
      for (int ix = 0; ix < set.width; ++ix) {
        const double expected = BruteForceDistance(set, border, ix, iy);
        if (std::isinf(expected))
          EXPECT_TRUE(std::isinf(dut(ix, iy)));
        else
          EXPECT_NEAR(dut(ix, iy), expected, 1e-5) << ix << "," << iy;
      }
  }
}

TEST(FineFrame, DividesCellsToTheLimitAndKeepsTheGround) {
  const GridFrame dut = FineFrame({10, 20, 0.068, {1, 2, 0.3}});
  EXPECT_EQ(dut.width, 20);
  EXPECT_DOUBLE_EQ(dut.cell_m, 0.034);
  EXPECT_EQ(FineFrame({10, 20, 0.05, {}}).width, 10);
  EXPECT_EQ(FineFrame({10, 20, 0.5, {}}).width, 100);
}

TEST(ObstacleMask, AHazardTakesEveryCellThatItTouchesAndNoNeighbour) {
  HazardMap map = EmptyFloor(4, 4, 0.5);
  Hazard glass;
  glass.hazard_class = HazardClass::kGlass;
  glass.footprint = {Rectangle({0.5, 0.5}, {1.0, 1.0}),    // exactly cell (1, 1)
                     Rectangle({1.6, 0.1}, {1.61, 1.4})};  // thinner than a fine cell
  map.hazards = {glass};
  const GridFrame fine = FineFrame(map.frame);
  const Grid<std::uint8_t> dut = ObstacleMask(map, 0.01, fine);
  EXPECT_EQ(std::count(dut.cells.begin(), dut.cells.end(), 1), 10 * 10 + 26);
  EXPECT_TRUE(dut(10, 10) && dut(19, 19) && !dut(9, 10) && !dut(20, 19));
  EXPECT_TRUE(dut(32, 2) && dut(32, 27) && !dut(31, 10) && !dut(32, 28));
}

TEST(ObstacleMask, ALaterFloorTakesALevelChangeBackAndAGlassStays) {
  HazardMap map = EmptyFloor(4, 4, 0.5);
  Hazard drop, glass, ramp;
  drop.hazard_class = HazardClass::kLevelChange;
  drop.height_m = -0.15;
  drop.footprint = {Rectangle({0.0, 0.0}, {2.0, 1.0})};
  glass.hazard_class = HazardClass::kGlass;
  glass.footprint = {Rectangle({0.0, 1.5}, {2.0, 2.0})};
  ramp.hazard_class = HazardClass::kLevelChange;
  ramp.height_m = 0.002;
  ramp.footprint = {Rectangle({1.0, 0.0}, {1.5, 2.0})};
  const GridFrame fine = FineFrame(map.frame);
  map.hazards = {drop, glass, ramp};
  const auto last = ObstacleMask(map, 0.01, fine);
  EXPECT_FALSE(last(25, 5));
  EXPECT_TRUE(last(15, 5) && last(35, 5) && last(25, 35));
  map.hazards = {ramp, drop, glass};
  EXPECT_TRUE(ObstacleMask(map, 0.01, fine)(25, 5));
  // What is laid into a pit does not fill it.
  Hazard mat = ramp;
  mat.hazard_class = HazardClass::kTerrain;
  map.hazards = {drop, glass, mat};
  EXPECT_TRUE(ObstacleMask(map, 0.01, fine)(25, 5));
}

TEST(ComputeSweepArea, AnOpenFloorsCornersAreOutOfADiscsReach) {
  const HazardMap map = EmptyFloor(80, 60, 0.05);  // 4 m x 3 m
  const double r = 0.2;
  const SweepArea dut = ComputeSweepArea(map, Disc(r), Disc(r), 0.01, {2, 1.5});
  const double corners = (4 - kPi) * r * r;
  EXPECT_NEAR(dut.area_m2(), 4 * 3 - corners, 0.06);
  EXPECT_FALSE(dut.sweepable(0, 0));
  EXPECT_TRUE(dut.sweepable(0, 30));
}

TEST(ComputeSweepArea, ANarrowerToolSweepsLessAndAWiderClearShapeReachesLess) {
  const HazardMap map = FromRows(R"(
    ##########
    #...#....#
    #...#....#
    #........#
    ##########)",
                                 0.5);
  const Vec2 start(1, 1);
  const auto area = [&](double clear, double tool) {
    return ComputeSweepArea(map, Disc(clear), Disc(tool), 0.01, start).sweepable_cells;
  };
  EXPECT_GT(area(0.2, 0.2), area(0.2, 0.15));
  EXPECT_GT(area(0.15, 0.15), area(0.2, 0.15));
  EXPECT_GT(2 * area(0.22, 0.1), 3 * area(0.3, 0.1));  // the passage of 0.5 m closes
  EXPECT_EQ(area(0.2, 0.15),
            ComputeSweepArea(map, Disc(0.2), Disc(0.15), 0.01, {3.75, 1.25}).sweepable_cells);
}

TEST(ComputeSweepArea, IsEmptyWhereTheStartIsNotClear) {
  const HazardMap map = EmptyFloor(40, 40, 0.05);
  for (const Vec2& start : {Vec2(0.05, 1), Vec2(-3, 1), Vec2(1e9, -1e9)})
    EXPECT_EQ(ComputeSweepArea(map, Disc(0.2), Disc(0.2), 0.01, start).sweepable_cells, 0);
  // 0.2 m from the wall is clear although the cell's centre is not.
  EXPECT_GT(ComputeSweepArea(map, Disc(0.2), Disc(0.2), 0.01, {0.201, 1}).sweepable_cells, 0);
}

TEST(ComputeSweepArea, AMirroredFloorHasTheMirroredArea) {
  const char* floor = "##########\n#...#....#\n#.#.#.##.#\n#........#\n##########";
  const char* mirrored = "##########\n#....#...#\n#.##.#.#.#\n#........#\n##########";
  const SweepArea a =
      ComputeSweepArea(FromRows(floor, 0.5), Disc(0.2), Disc(0.15), 0.01, {0.75, 0.75});
  const SweepArea b =
      ComputeSweepArea(FromRows(mirrored, 0.5), Disc(0.2), Disc(0.15), 0.01, {4.25, 0.75});
  ASSERT_EQ(a.sweepable_cells, b.sweepable_cells);
  for (int iy = 0; iy < a.frame.height; ++iy)
    for (int ix = 0; ix < a.frame.width; ++ix)
      ASSERT_EQ(a.sweepable(ix, iy), b.sweepable(a.frame.width - 1 - ix, iy));
}

TEST(ComputeSweepArea, AFootprintAsWideAsItsCellFitsWhenWallsAreDrawnBack) {
  HazardMap map = FromRows(R"(
    ######
    #....#
    #.##.#
    #....#
    ######)",
                           0.5, {2, -1, 0.4});
  const Vec2 start = map.frame.Center(1, 1);
  const Shape2 box = Box(0.5, 0.5);
  EXPECT_EQ(ComputeSweepArea(map, box, box, 0.01, start).sweepable_cells, 0);
  map.inset_m = 0.03;
  const SweepArea dut = ComputeSweepArea(map, box, box, 0.01, start);
  EXPECT_EQ(dut.sweepable_cells, 10 * 100);  // every free cell, to its corners
  EXPECT_EQ(ComputeSweepArea(map, Box(0.6, 0.6), box, 0.01, start).sweepable_cells, 0);
}

TEST(ComputeSweepArea, ALongFootprintTurnsWithItsCorridor) {
  HazardMap map = FromRows(R"(
    ########
    #......#
    #......#
    #....###
    ####.###
    ####.###
    ########)",
                           0.5);
  map.inset_m = 0.03;
  const Shape2 bar = Box(1.0, 0.5);
  const SweepArea dut = ComputeSweepArea(map, bar, bar, 0.01, {1.5, 2});
  EXPECT_TRUE(dut.sweepable(45, 12));  // the dead end, entered with its long side along it
  EXPECT_FALSE(dut.reachable(45, 12));
  EXPECT_TRUE(dut.reachable(45, 20));
}

TEST(CoverageMeter, ADiscsStraightRunSweepsACapsule) {
  const HazardMap map = EmptyFloor(100, 100, 0.05);
  const SweepArea area = ComputeSweepArea(map, Disc(0.2), Disc(0.2), 0.01, {2.5, 2.5});
  const Shape2 tool = Disc(0.2);
  for (const double yaw : {0.0, 0.3, 0.8, kPi / 2, 2.5}) {
    CoverageMeter dut(area, tool);
    const Vec2 from = Vec2(2.5, 2.5) - Pose2{0, 0, yaw}.Rotate({1, 0});
    const Vec2 to = Vec2(2.5, 2.5) + Pose2{0, 0, yaw}.Rotate({1, 0});
    dut.Add({from.x(), from.y(), yaw});
    dut.Add({to.x(), to.y(), yaw});
    const double expected_m2 = 2 * 0.4 + kPi * 0.04;
    EXPECT_NEAR(dut.coverage() * area.area_m2(), expected_m2, 0.03) << yaw;
    EXPECT_EQ(dut.overlap(), 0);
  }
}

// A tool of 0.6 m on a robot of 0.36 m beside a wall of 0.05 m, behind which there is more floor.
class ToolWiderThanItsRobot : public ::testing::Test {
 protected:
  ToolWiderThanItsRobot() {
    for (int ix = 0; ix < 80; ++ix) map_.occupancy(ix, kWall) = CellState::kOccupied;
  }
  static constexpr int kWall = 30;  // the wall's row
  HazardMap map_ = EmptyFloor(80, 60, 0.05);
  const Shape2 clear_ = Disc(0.18), tool_ = Disc(0.3);
};

TEST_F(ToolWiderThanItsRobot, ReachesNoFloorBehindAWall) {
  const SweepArea dut = ComputeSweepArea(map_, clear_, tool_, 0.01, {1, 0.5});
  for (int ix = 0; ix < 80; ++ix) {
    EXPECT_TRUE(dut.sweepable(ix, kWall - 1)) << ix;
    EXPECT_FALSE(dut.sweepable(ix, kWall + 1)) << ix;
  }
  EXPECT_TRUE(ComputeSweepArea(map_, clear_, Disc(0.18), 0.01, {1, 0.5}).hidden.cells.empty());
}

TEST_F(ToolWiderThanItsRobot, SweepsNothingBehindAWall) {
  map_.occupancy(40, kWall) = CellState::kFree;  // too narrow for the robot, but one sees through
  const SweepArea area = ComputeSweepArea(map_, clear_, tool_, 0.01, {1, 0.5});
  CoverageMeter dut(area, tool_);
  dut.Add({0.5, 1.28, 0});
  dut.Add({3.5, 1.28, 0});
  EXPECT_EQ(dut.passes()(20, kWall - 1), 1);
  EXPECT_EQ(dut.passes()(20, kWall + 1), 0);
  EXPECT_EQ(dut.passes()(60, kWall + 1), 0);
  EXPECT_EQ(dut.passes()(40, kWall + 1), 1) << "through the gap";
}

// A robot of 0.8 m x 0.4 m starts in an aisle of 0.7 m, in which it cannot turn: what it can sweep
// begins ahead, where it can. Across the aisle it does not fit, and backwards it is not led.
TEST(ComputeSweepArea, ALongRobotLeavesANarrowAisleStraightAhead) {
  HazardMap map = EmptyFloor(80, 60, 0.05);
  for (int iy = 0; iy < 60; ++iy)
    for (int ix = 0; ix < 40; ++ix)
      if (iy < 23 || iy >= 37) map.occupancy(ix, iy) = CellState::kOccupied;
  RobotSpec robot;
  robot.outline_B = {Rectangle({-0.4, -0.2}, {0.4, 0.2})};
  robot.clear = Disc(std::hypot(0.4, 0.2));
  robot.tool = Disc(0.2);
  const auto area_m2 = [&](const Pose2& start) {
    return ComputeSweepArea(map, robot, robot.clear, robot.tool, start).area_m2();
  };
  const double room_m2 = area_m2({3, 1.5, 0});
  EXPECT_GT(room_m2, 3.5);
  EXPECT_EQ(area_m2({0.5, 1.5, 0}), room_m2);
  EXPECT_EQ(area_m2({0.5, 1.5, kPi}), 0);
  EXPECT_EQ(area_m2({0.5, 1.5, kPi / 2}), 0);
  map.occupancy(20, 29) = CellState::kOccupied;
  EXPECT_EQ(area_m2({0.5, 1.5, 0}), 0);
}

TEST(CoverageMeter, ManyShortStepsCountAsOneLongOne) {
  const HazardMap map = EmptyFloor(100, 60, 0.05);
  const SweepArea area = ComputeSweepArea(map, Disc(0.2), Disc(0.2), 0.01, {2.5, 1.5});
  CoverageMeter once(area, Disc(0.2)), often(area, Disc(0.2));
  const std::vector<Vec2> corners = {{0.5, 0.5}, {4.5, 0.6}, {4.5, 2.0}, {0.5, 1.2}, {2, 0.3}};
  for (std::size_t k = 0; k < corners.size(); ++k) {
    once.Add({corners[k].x(), corners[k].y(), 0});
    for (int i = 1; k > 0 && i <= 700; ++i) {
      const Vec2 p = corners[k - 1] + i / 700.0 * (corners[k] - corners[k - 1]);
      often.Add({p.x(), p.y(), 0});
    }
  }
  EXPECT_NEAR(once.coverage(), often.coverage(), 1e-3);
  EXPECT_NEAR(once.overlap(), often.overlap(), 2e-3);
  EXPECT_GT(once.overlap(), 0.02);
}

TEST(CoverageMeter, AWayThereAndBackIsTwoPassesAndStandingIsOne) {
  const HazardMap map = EmptyFloor(200, 20, 0.05);
  const SweepArea area = ComputeSweepArea(map, Disc(0.2), Disc(0.2), 0.01, {1, 0.5});
  CoverageMeter dut(area, Disc(0.2));
  for (int i = 0; i < 50; ++i) dut.Add({1, 0.5, 0.1 * i});
  EXPECT_EQ(dut.overlap(), 0);
  dut.Add({9, 0.5, 0});
  EXPECT_EQ(dut.overlap(), 0);
  dut.Add({1, 0.5, 0});
  EXPECT_GT(dut.overlap(), 0.8);  // but near the turn
  EXPECT_LT(dut.overlap(), 1.0);
  EXPECT_EQ(dut.passes()(40, 10), 2);
}

TEST(CoverageMeter, ACarriedToolSweepsNothingOnItsWay) {
  const HazardMap map = EmptyFloor(200, 20, 0.05);
  const SweepArea area = ComputeSweepArea(map, Disc(0.2), Disc(0.2), 0.01, {1, 0.5});
  CoverageMeter dut(area, Disc(0.2));
  dut.Add({1, 0.5, 0});
  dut.Lift();
  dut.Add({9, 0.5, 0});
  EXPECT_EQ(dut.passes()(100, 10), 0);
  EXPECT_EQ(dut.passes()(180, 10), 1);
}

TEST(CoverageMeter, ASquareToolSweepsItsWidth) {
  const HazardMap map = EmptyFloor(100, 40, 0.05);
  const SweepArea area = ComputeSweepArea(map, Box(0.5, 0.5), Box(0.5, 0.5), 0.01, {1, 1});
  CoverageMeter dut(area, Box(0.5, 0.5));
  dut.Add({1.0, 1.0, 0});
  dut.Add({3.0, 1.0, 0});
  EXPECT_NEAR(dut.coverage() * area.area_m2(), 2.5 * 0.5, 0.15);
  Path path(2);
  path[0].p_W = {1, 1};
  path[1].p_W = {3, 1};
  EXPECT_EQ(MeasureCoverage(area, Box(0.5, 0.5), path).coverage, dut.coverage());
}

TEST(CoverageMeter, PosesOffTheMapAreHarmless) {
  const HazardMap map = EmptyFloor(40, 40, 0.05);
  const SweepArea area = ComputeSweepArea(map, Disc(0.2), Disc(0.2), 0.01, {1, 1});
  for (const Shape2& tool : {Disc(0.2), Box(0.3, 0.3)}) {
    CoverageMeter dut(area, tool);
    for (const Vec2& p : {Vec2(-5, 1), Vec2(7, 1), Vec2(1, -50), Vec2(1, 1)})
      dut.Add({p.x(), p.y(), 0});
    EXPECT_GT(dut.coverage(), 0.1);
    EXPECT_LE(dut.coverage(), 1);
  }
}

}  // namespace
}  // namespace floorproof
