// SPDX-License-Identifier: Apache-2.0
#include "planners/risk/risk_grid.h"

#include <gtest/gtest.h>

#include "base/streams.h"
#include "tests/planners/risk_floors.h"

namespace floorproof {
namespace {

using testing::DiscRobot;
using testing::DrawHazards;
using testing::EmptyFloor;
using testing::PaperTables;
using testing::SquareRobot;
using testing::Text;

RiskGrid Make(const HazardMap& map, const RobotSpec& robot,
              std::optional<double> cell_m = std::nullopt) {
  return MakeRiskGrid(map, robot, PaperTables(), cell_m);
}
// In cells of 0.5 m, of a robot as wide.
RiskGrid Make(const HazardMap& map) { return Make(map, SquareRobot(0.5)); }
std::string TextOf(const std::string& rows) { return Text(Make(DrawHazards(rows, 0.5))); }

Hazard Of(HazardClass hazard_class, const Polygon& footprint) {
  Hazard hazard;
  hazard.hazard_class = hazard_class;
  hazard.footprint = {footprint};
  return hazard;
}

// A room of width x height fine cells within walls of these thicknesses.
HazardMap FineRoom(int width, int height, int left, int below, int right, int above) {
  HazardMap map = EmptyFloor(left + width + right, below + height + above, 0.05);
  for (int iy = 0; iy < map.frame.height; ++iy)
    for (int ix = 0; ix < map.frame.width; ++ix)
      if (ix < left || iy < below || ix >= left + width || iy >= below + height)
        map.occupancy(ix, iy) = CellState::kOccupied;
  return map;
}

TEST(RiskGrid, TheLeastCellHoldsTheRobotHoweverItIsTurned) {
  EXPECT_EQ(LeastCellWidth(DiscRobot(0.18, 0.3)), 0.36);
  EXPECT_EQ(LeastCellWidth(SquareRobot(0.5)), 0.5);
  RobotSpec robot = SquareRobot(0.5);
  robot.clear.footprint_B = Rectangle(Vec2(-0.1, -0.25), Vec2(0.4, 0.25));  // off its centre
  EXPECT_EQ(LeastCellWidth(robot), 0.8);
}

TEST(RiskGrid, TerrainBeyondMeasuredLimitsIsSolid) {
  HazardMap map = DrawHazards("...\n.=.\n...\n", 0.5);
  EXPECT_TRUE(Make(map).contents(1, 1).terrain());
  map.hazards[0].crossable = true;
  EXPECT_TRUE(Make(map).contents(1, 1).terrain());
  map.hazards[0].crossable = false;
  EXPECT_FALSE(Make(map).contents(1, 1).terrain());
  EXPECT_TRUE(Make(map).contents(1, 1).solid);
}

TEST(RiskGrid, MapCellsAsWideAsTheRobotAreTheCells) {
  const Pose2 X_WG{3, -2, 0.7};
  const std::string rows = "..#.\n.Gv=\n....\n";
  for (const RobotSpec& robot :
       {SquareRobot(0.5), DiscRobot(0.25, 0.5), DiscRobot(0.2504, 0.5), DiscRobot(0.13, 0.2)}) {
    const RiskGrid dut = Make(DrawHazards(rows, 0.5, X_WG), robot);
    EXPECT_EQ(Text(dut), rows);
    EXPECT_EQ(dut.frame.cell_m, 0.5);
    EXPECT_EQ(dut.frame.Center(1, 2), DrawHazards(rows, 0.5, X_WG).frame.Center(1, 2));
    EXPECT_FALSE(dut.walled_all_round);
  }
}

TEST(RiskGrid, WiderMapCellsAreCutIntoEqualParts) {
  const HazardMap map = DrawHazards("..#\nG..\n", 1.0);
  const std::string halves = "....##\n....##\nGG....\nGG....\n";
  EXPECT_EQ(Text(Make(map, SquareRobot(0.5))), halves);
  EXPECT_EQ(Text(Make(map, DiscRobot(0.18, 0.3))), halves);  // 2.8 of them fit
  EXPECT_EQ(Make(map, DiscRobot(0.18, 0.3)).frame.cell_m, 0.5);
  const RiskGrid thirds = Make(map, SquareRobot(1.0 / 3));
  EXPECT_EQ(thirds.frame.width, 9);
  EXPECT_NEAR(thirds.frame.cell_m, 1.0 / 3, 1e-12);
  EXPECT_EQ(Text(Make(map, SquareRobot(0.51))), "..#\nG..\n");
}

TEST(RiskGrid, AWidthThatIsAskedForIsRoundedUpToWhatTheMapAllows) {
  const HazardMap map = EmptyFloor(8, 4, 0.5);
  EXPECT_EQ(Make(map, SquareRobot(0.2), 1.0).frame.width, 4);
  EXPECT_EQ(Make(map, SquareRobot(0.2), 1.0).frame.cell_m, 1.0);
  EXPECT_EQ(Make(map, SquareRobot(0.2), 0.5).frame.cell_m, 0.5);
  EXPECT_EQ(Make(map, SquareRobot(0.2), 0.21).frame.cell_m, 0.25);
  EXPECT_NEAR(Make(map, SquareRobot(0.2), 0.62).frame.cell_m, 0.65, 1e-12);
}

TEST(RiskGrid, OnFineMapsTheLatticeLiesWhereMostCellsAreFree) {
  // 2 m x 1 m, three cells of wall to the left and two below: only one place has all 4 x 2 cells.
  const RiskGrid hall = Make(FineRoom(40, 20, 3, 2, 3, 2));
  EXPECT_EQ(Text(hall), "WWWWWW\nW....W\nW....W\nWWWWWW\n");
  EXPECT_LT((hall.frame.Center(1, 1) - Vec2(0.15 + 0.25, 0.1 + 0.25)).norm(), 1e-9);
  EXPECT_TRUE(hall.walled_all_round);
  // A robot of 0.36 m needs eight of the map's cells.
  const RiskGrid disc = Make(FineRoom(40, 20, 3, 2, 3, 2), DiscRobot(0.18, 0.3));
  EXPECT_NEAR(disc.frame.cell_m, 0.4, 1e-12);
  EXPECT_EQ(std::ranges::count_if(disc.contents.cells, [](const RiskCell& c) { return c.free(); }),
            5 * 2);
  // Lengths that differ by a millimetre are the same.
  EXPECT_NEAR(Make(FineRoom(40, 20, 3, 2, 3, 2), SquareRobot(0.5008)).frame.cell_m, 0.5, 1e-12);
  EXPECT_NEAR(Make(FineRoom(40, 20, 3, 2, 3, 2), SquareRobot(0.502)).frame.cell_m, 0.55, 1e-12);
}

TEST(RiskGrid, OfPlacesAsGoodItTakesTheLowest) {
  // Four cells to spare in x, one in y.
  const RiskGrid dut = Make(FineRoom(44, 21, 3, 2, 3, 2));
  EXPECT_LT((dut.frame.Center(1, 1) - Vec2(0.15 + 0.25, 0.1 + 0.25)).norm(), 1e-9);
}

TEST(RiskGrid, TurnsWithTheMap) {
  HazardMap map = FineRoom(40, 20, 3, 2, 3, 2);
  map.frame.X_WG = {4, 1, -1.2};
  const RiskGrid dut = Make(map);
  EXPECT_EQ(Text(dut), "WWWWWW\nW....W\nW....W\nWWWWWW\n");
  EXPECT_LT((dut.frame.Center(2, 1) - map.frame.X_WG * Vec2(0.15 + 0.75, 0.1 + 0.25)).norm(), 1e-9);
  EXPECT_EQ(dut.frame.X_WG.yaw_rad, -1.2);
}

TEST(RiskGrid, CellsThatReachBeyondTheMapAreOuterWall) {
  const RiskGrid dut = Make(EmptyFloor(25, 23, 0.05));
  EXPECT_EQ(Text(dut), "WWW\n..W\n..W\n");
  EXPECT_FALSE(dut.walled_all_round);
  HazardMap map = EmptyFloor(25, 23, 0.05);
  map.hazards.push_back(Of(HazardClass::kTerrain, Rectangle({1.1, 0.1}, {1.2, 0.2})));
  map.occupancy(22, 22) = CellState::kOccupied;
  EXPECT_EQ(Text(Make(map)), "WW#\n..W\n..T\n") << "hazards, the one yet nowhere to drive";
}

TEST(RiskGrid, UnknownCellsAreWhatTheMapSaysOfThem) {
  const std::string rows = ".....\n..?.#\n.....\n";
  EXPECT_EQ(TextOf(rows), ".....\n..W.#\n.....\n");
  HazardMap map = DrawHazards(rows, 0.5);
  map.unknown_is_wall = false;
  EXPECT_EQ(Text(Make(map)), ".....\n....#\n.....\n");
}

TEST(RiskGrid, OuterWallsAreTheRingWhereAllOfItIsWall) {
  EXPECT_EQ(TextOf("######\n#.#..#\n#....#\n##?###\n"), "WWWWWW\nW.#..W\nW....W\nWWWWWW\n");
  EXPECT_EQ(TextOf("######\n#.#..#\n#.....\n######\n"), "######\n#.#..#\n#.....\n######\n");
  EXPECT_EQ(TextOf("#####\n#####\n##.##\n#####\n#####\n"), "WWWWW\nW###W\nW#.#W\nW###W\nWWWWW\n")
      << "what stands before a wall is furniture";
  EXPECT_TRUE(Make(DrawHazards("###\n#.#\n###\n", 0.5)).walled_all_round);
  EXPECT_FALSE(Make(DrawHazards("###\n..#\n###\n", 0.5)).walled_all_round);
}

TEST(RiskGrid, AHazardInTheOuterWallIsAHazard) {
  HazardMap map = DrawHazards("####\n#..#\n####\n", 0.5);
  map.hazards.push_back(Of(HazardClass::kGlass, Rectangle({0.4, 0.6}, {0.45, 0.9})));
  EXPECT_EQ(Text(Make(map)), "WWWW\nG..W\nWWWW\n");
}

TEST(RiskGrid, AFootprintTouchesByMoreThanABorder) {
  HazardMap map = EmptyFloor(5, 3, 0.5);
  map.hazards = {Of(HazardClass::kGlass, Rectangle({1.0, 0.5}, {1.5, 1.0}))};
  EXPECT_EQ(Text(Make(map)), ".....\n..G..\n.....\n");
  map.hazards = {Of(HazardClass::kGlass, Rectangle({0.999, 0.5}, {1.5, 1.001}))};
  EXPECT_EQ(Text(Make(map)), ".GG..\n.GG..\n.....\n");
  map.hazards = {Of(HazardClass::kGlass, Rectangle({0.1, 0.995}, {2.4, 1.005}))};
  EXPECT_EQ(Text(Make(map)), "GGGGG\nGGGGG\n.....\n") << "a pane between two rows of cells";
  map.hazards = {Of(HazardClass::kGlass, Rectangle({0.1, 0.99}, {2.4, 1.0}))};
  EXPECT_EQ(Text(Make(map)), ".....\nGGGGG\n.....\n") << "one that ends at the border";
  map.hazards = {Of(HazardClass::kLevelChange, {{0.6, 0.1}, {2.4, 0.1}, {1.5, 1.4}})};
  EXPECT_EQ(Text(Make(map)), "..vv.\n.vvvv\n.vvvv\n");
  map.hazards = {Of(HazardClass::kTerrain, Rectangle({-9, -9}, {9, 9}))};
  EXPECT_EQ(Text(Make(map)), "=====\n=====\n=====\n") << "cells that no edge crosses, too";
}

TEST(RiskGrid, WhatLiesBeyondTheMapIsNoHazardOfIt) {
  HazardMap map = EmptyFloor(3, 3, 0.5);
  map.hazards = {Of(HazardClass::kLevelChange, Rectangle({1.5, 0}, {2.5, 1.5})),
                 Of(HazardClass::kLevelChange, Rectangle({-5, -5}, {-4, 9}))};
  EXPECT_EQ(Text(Make(map)), "...\n...\n...\n");
  map.hazards = {Of(HazardClass::kLevelChange, Rectangle({1.4, -1}, {2.5, 0.4}))};
  EXPECT_EQ(Text(Make(map)), "...\n...\n..v\n");
}

TEST(RiskGrid, ACellIsOfTheHazardOfTheGreatestWeightAndSolidIfOneIs) {
  // By weight: level change 11.895, terrain 9.58, glass 3.72, blind object 1.86.
  const std::vector<HazardClass> classes = {HazardClass::kLevelChange, HazardClass::kTerrain,
                                            HazardClass::kGlass, HazardClass::kBlindObject};
  for (std::size_t a = 0; a < 4; ++a)
    for (std::size_t b = a; b < 4; ++b)
      for (const bool swapped : {false, true}) {  // whichever comes later
        HazardMap map = EmptyFloor(1, 1, 0.5);
        map.hazards = {Of(classes[swapped ? b : a], Rectangle({0.1, 0.1}, {0.2, 0.2})),
                       Of(classes[swapped ? a : b], Rectangle({0.3, 0.3}, {0.4, 0.4}))};
        const RiskCell dut = Make(map).contents(0, 0);
        EXPECT_EQ(dut.hazard, classes[a]) << a << ", " << b;
        EXPECT_EQ(dut.solid, !(a == 1 && b == 1)) << a << ", " << b;
        EXPECT_EQ(dut.terrain(), !dut.solid);
      }
  // It is the tables that weigh.
  FmeaTables tables = PaperTables();
  tables.detectability[static_cast<std::size_t>(HazardClass::kGlass)] = 30;
  HazardMap map = EmptyFloor(1, 1, 0.5);
  map.hazards = {Of(HazardClass::kLevelChange, Rectangle({0.1, 0.1}, {0.2, 0.2})),
                 Of(HazardClass::kGlass, Rectangle({0.3, 0.3}, {0.4, 0.4}))};
  EXPECT_EQ(MakeRiskGrid(map, SquareRobot(0.5), tables, {}).contents(0, 0).hazard,
            HazardClass::kGlass);
}

TEST(RiskGrid, AnythingOccupiedInACellIsABlindObject) {
  HazardMap map = FineRoom(40, 20, 3, 2, 3, 2);
  map.occupancy(3 + 12, 2 + 9) = CellState::kOccupied;   // in the second cell, at its upper border
  map.occupancy(3 + 35, 2 + 12) = CellState::kOccupied;  // in the fourth
  map.hazards.push_back(Of(HazardClass::kTerrain, Rectangle({1.66, 0.7}, {1.9, 0.8})));
  EXPECT_EQ(Text(Make(map)), "WWWWWW\nW...TW\nW.#..W\nWWWWWW\n");
}

// A strip that is drawn some way into a wall, lengthwise or beside it, does not make terrain of it.
TEST(RiskGrid, WhatShapesTheFloorIsNotInAWall) {
  for (const HazardClass of : {HazardClass::kTerrain, HazardClass::kLevelChange}) {
    HazardMap map = EmptyFloor(5, 3, 0.5);
    map.occupancy(3, 1) = CellState::kOccupied;
    const std::string walls = Text(Make(map));
    map.hazards = {Of(of, Rectangle({1.47, 0.6}, {1.53, 0.7}))};
    const RiskGrid dut = Make(map);
    EXPECT_EQ(dut.contents(2, 1).hazard, of);
    EXPECT_EQ(dut.contents(3, 1).hazard, HazardClass::kBlindObject);
    map.hazards = {Of(of, Rectangle({1.51, 0.51}, {1.99, 0.99}))};
    EXPECT_EQ(Text(Make(map)), walls) << "it is in the wall as a whole";
  }
}

// The rule of risk_grid.h once more, slowly: on random floors of fine cells.
TEST(RiskGrid, OnAnyFineMapTheRuleHolds) {
  Stream random(1, 0, "specks");
  int walled_floors = 0;
  for (int round = 0; round < 40; ++round) {
    const double cell_m = round % 2 ? 0.05 : 0.1;
    constexpr int side = 6;  // of cells of 0.05 m
    const int cut = round % 2 ? 1 : 2;
    HazardMap map = EmptyFloor(8 + static_cast<int>(random.Below(30)),
                               8 + static_cast<int>(random.Below(30)), cell_m);
    map.unknown_is_wall = round % 3 != 0;
    for (CellState& cell : map.occupancy.cells) {
      const double u = random.Uniform();
      cell = u < 0.01 ? CellState::kOccupied : u < 0.02 ? CellState::kUnknown : CellState::kFree;
    }
    if (round % 4 == 0)
      for (int iy = 0; iy < map.frame.height; ++iy)
        for (int ix = 0; ix < map.frame.width; ++ix)
          if (ix == 0 || iy == 0 || ix == map.frame.width - 1 || iy == map.frame.height - 1)
            map.occupancy(ix, iy) = CellState::kOccupied;
    const int width = map.frame.width * cut, height = map.frame.height * cut;
    struct Seen {
      bool beyond = false, wall = false, occupied = false;
    };
    const auto look = [&](int left, int low) {
      Seen seen;
      for (int y = low; y < low + side; ++y)
        for (int x = left; x < left + side; ++x) {
          if (x < 0 || y < 0 || x >= width || y >= height) {
            seen.beyond = true;
            continue;
          }
          seen.wall |= map.IsWall(x / cut, y / cut);
          seen.occupied |= map.occupancy(x / cut, y / cut) == CellState::kOccupied;
        }
      return seen;
    };
    int most = -1, best_x = 0, best_y = 0;
    for (int x0 = 0; x0 < side; ++x0)
      for (int y0 = 0; y0 < side; ++y0) {
        int free = 0;
        for (int y = y0; y < height; y += side)
          for (int x = x0; x < width; x += side) {
            const Seen seen = look(x, y);
            free += !seen.beyond && !seen.wall;
          }
        if (free > most) most = free, best_x = x0, best_y = y0;
      }
    const RiskGrid dut = Make(map, SquareRobot(0.3));
    ASSERT_NEAR(dut.frame.cell_m, 0.3, 1e-12);
    const int x0 = best_x == 0 ? 0 : best_x - side, y0 = best_y == 0 ? 0 : best_y - side;
    ASSERT_LT((dut.frame.X_WG.p() - Vec2(x0, y0) * 0.05).norm(), 1e-9) << round;
    ASSERT_GE(x0 + dut.frame.width * side, width);
    ASSERT_LT(x0 + (dut.frame.width - 1) * side, width);
    ASSERT_GE(y0 + dut.frame.height * side, height);
    ASSERT_LT(y0 + (dut.frame.height - 1) * side, height);
    const auto in_ring = [&](int ix, int iy) {
      return ix == 0 || iy == 0 || ix == dut.frame.width - 1 || iy == dut.frame.height - 1;
    };
    bool walled = true;
    for (int iy = 0; iy < dut.frame.height; ++iy)
      for (int ix = 0; ix < dut.frame.width; ++ix) {
        const Seen seen = look(x0 + ix * side, y0 + iy * side);
        walled &= !in_ring(ix, iy) || seen.beyond || seen.wall;
      }
    ASSERT_EQ(dut.walled_all_round, walled);
    walled_floors += walled;
    int free = 0;
    for (int iy = 0; iy < dut.frame.height; ++iy)
      for (int ix = 0; ix < dut.frame.width; ++ix) {
        const Seen seen = look(x0 + ix * side, y0 + iy * side);
        const RiskCell& cell = dut.contents(ix, iy);
        ASSERT_EQ(cell.solid, seen.beyond || seen.wall) << ix << ", " << iy;
        ASSERT_EQ(cell.hazard.has_value(), seen.occupied && !(walled && in_ring(ix, iy)))
            << ix << ", " << iy;
        free += cell.free();
      }
    ASSERT_EQ(free, most);
  }
  EXPECT_GE(walled_floors, 10);
  EXPECT_LT(walled_floors, 20);
}

}  // namespace
}  // namespace floorproof
