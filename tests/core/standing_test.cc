// SPDX-License-Identifier: Apache-2.0
// On which floor a robot stands, and what it cannot stand in.
#include "env/core/standing.h"

#include <gtest/gtest.h>

namespace floorproof {
namespace {

// Round, 0.2 m in radius, two wheels beside the middle, belly at 30 mm, trusted with steps of 6 mm.
RobotSpec Robot() {
  RobotSpec robot;
  for (const double y : {0.15, -0.15}) {
    WheelSpec wheel;
    wheel.p_BW = {0, y, 0.05};
    wheel.radius_m = 0.05;
    wheel.half_width_m = 0.01;
    robot.wheels.push_back(wheel);
  }
  robot.clear.radius_m = robot.inscribed_radius_m = robot.circumscribed_radius_m = 0.2;
  robot.outline_B = {RegularPolygon(Vec2::Zero(), 0.2, 64)};
  robot.clearance_m = 0.03;
  robot.height_m = 0.3;
  robot.step_m = 0.006;
  return robot;
}

HazardMap Room() {
  HazardMap map;
  map.frame = {8, 8, 0.5, {}};
  map.occupancy = Grid<CellState>(8, 8);
  return map;
}

Hazard Level(const Polygon& outline, double height_m) {
  Hazard hazard;
  hazard.id = hazard.type = height_m > 0 ? "platform" : "pit";
  hazard.hazard_class = HazardClass::kLevelChange;
  hazard.height_m = height_m;
  hazard.footprint = {outline};
  if (height_m > 0)
    hazard.solids = {{Solid::Kind::kPrism, outline, {}, 0, height_m}};
  else
    hazard.solids = {{Solid::Kind::kCut, outline, {}, height_m, 0}};
  return hazard;
}

Hazard Block(HazardClass of, const Polygon& outline, double low_m, double high_m) {
  Hazard hazard;
  hazard.id = hazard.type = "block";
  hazard.hazard_class = of;
  hazard.footprint = {outline};
  hazard.height_m = high_m;
  hazard.solids = {{Solid::Kind::kPrism, outline, {}, low_m, high_m}};
  return hazard;
}

Standing At(const HazardMap& map, double x_m, double y_m, double yaw_rad = 0) {
  return StandAt(map, Robot(), {x_m, y_m, yaw_rad});
}

TEST(StandAt, ItStandsOnTheLevelUnderItsWheels) {
  for (const double height_m : {0.004, 0.05, 0.15, -0.05, -0.5}) {
    HazardMap map = Room();
    map.hazards = {Level(Rectangle({1, 1}, {3, 3}), height_m)};
    EXPECT_EQ(At(map, 2, 2).floor_m, height_m);
    EXPECT_EQ(At(map, 2, 2).rests_m, height_m);
    EXPECT_EQ(At(map, 2, 2).obstruction, "") << At(map, 2, 2).why;
    EXPECT_EQ(At(map, 0.5, 0.5).floor_m, 0);
    EXPECT_EQ(LevelAt(map, {2, 2}), height_m);
  }
}

TEST(StandAt, TheLaterLevelIsTheFloor) {
  HazardMap map = Room();
  map.hazards = {Level(Rectangle({1, 1}, {3, 3}), 0.1), Level(Rectangle({1, 1}, {3, 3}), -0.2)};
  map.hazards[0].solids.clear();  // as the pit has cut it
  EXPECT_EQ(At(map, 2, 2).floor_m, -0.2);
}

// A drawing's level is drawn back from its cells: over their rim there is none.
TEST(StandAt, ALevelIsWhereItIsBuilt) {
  for (const double height_m : {0.05, -0.15}) {
    HazardMap map = Room();
    map.hazards = {Level(Rectangle({1.1, 1.1}, {2.9, 2.9}), height_m)};
    map.hazards[0].footprint = {Rectangle({1, 1}, {3, 3})};
    EXPECT_EQ(At(map, 2, 2).floor_m, height_m);
    EXPECT_EQ(LevelAt(map, {2.95, 2}), 0);
    EXPECT_NE(At(map, 2, 2.8).why.find("stands across the edge of"), std::string::npos);
  }
}

// Whatever floor the groove lies in, and however it and the robot are turned.
TEST(StandAt, AWheelDoesNotSinkInAGroove) {
  const auto groove = [](double width_m, double depth_m) {
    Hazard hazard = Block(HazardClass::kTerrain,
                          Rectangle({0.5, 2 - width_m / 2}, {3.5, 2 + width_m / 2}), -depth_m, 0);
    hazard.id = "trench";
    hazard.solids[0].kind = Solid::Kind::kCut;
    return hazard;
  };
  HazardMap map = Room();
  for (const double yaw_rad : {0.0, 0.4, 1.5}) {
    map.hazards = {groove(0.6, 0.05)};
    EXPECT_EQ(At(map, 2, 2, yaw_rad).obstruction, "trench");
    EXPECT_NE(At(map, 2, 2, yaw_rad).why.find("0.050 m below its floor"), std::string::npos);
    EXPECT_EQ(At(map, 2, 2.6, yaw_rad).obstruction, "") << "beside it";
    map.hazards = {groove(0.6, 0.02)};
    EXPECT_EQ(At(map, 2, 2, yaw_rad).obstruction, "") << "no deeper than its belly";
    map.hazards = {groove(0.6, 0.05),
                   Block(HazardClass::kTerrain, Rectangle({1, 1}, {3, 3}), 0, 0.01)};
    EXPECT_EQ(At(map, 2, 2, yaw_rad).obstruction, "") << "bridged";
  }
  // A wheel that rolls across a narrow one stays on its edges; one that rolls along it sinks.
  map.hazards = {groove(0.06, 0.05)};
  EXPECT_EQ(At(map, 2, 2, kPi / 2).obstruction, "");
  EXPECT_EQ(At(map, 2, 2.15).obstruction, "trench");
  Hazard platform = Level(Rectangle({1, 1}, {3, 3}), 0.1);
  platform.solids.push_back(platform.solids[0]);  // as the groove has cut it
  platform.solids[0].base = Rectangle({1, 1}, {3, 1.97});
  platform.solids[1].base = Rectangle({1, 2.03}, {3, 3});
  map.hazards = {platform, groove(0.06, 0.05)};
  EXPECT_EQ(At(map, 2, 2, kPi / 2).obstruction, "");
  EXPECT_EQ(At(map, 2, 2, kPi / 2).floor_m, 0.1);
  EXPECT_EQ(At(map, 2, 2, 0.3).floor_m, 0.1);
  map.hazards = {Level(Rectangle({1, 1}, {3, 3}), 0.1), groove(0.6, 0.01)};
  EXPECT_NE(At(map, 2, 2).why.find("0.110 m below its floor"), std::string::npos);
}

TEST(StandAt, AcrossAnEdgeItDoesNotStand) {
  for (const double height_m : {0.05, -0.05, 0.004}) {
    HazardMap map = Room();
    map.hazards = {Level(Rectangle({0, 2}, {4, 4}), height_m)};
    EXPECT_EQ(At(map, 2, 2).obstruction, map.hazards[0].id) << height_m;
    EXPECT_NE(At(map, 2, 2).why.find("across the edge"), std::string::npos);
    // Along the edge its wheels are on one side.
    if (height_m < 0) {
      EXPECT_EQ(At(map, 2, 1.9, kPi / 2).obstruction, "") << "it reaches over it";
    }
  }
}

TEST(StandAt, ItsBodyDoesNotStandInAPlatformBesideIt) {
  HazardMap map = Room();
  map.hazards = {Level(Rectangle({0, 2}, {4, 4}), 0.05)};
  EXPECT_EQ(At(map, 2, 1.79).obstruction, "");
  EXPECT_EQ(At(map, 2, 1.81).obstruction, "platform");
  // Lower than its belly and off its wheels, a platform lies beneath it.
  map.hazards = {Level(Rectangle({0, 2}, {4, 4}), 0.02)};
  EXPECT_EQ(At(map, 2, 1.83).obstruction, "");
}

TEST(StandAt, SolidsAreRefusedWhereTheyOverlapAndNotWhereTheyTouch) {
  for (const HazardClass of : {HazardClass::kBlindObject, HazardClass::kGlass}) {
    HazardMap map = Room();
    map.hazards = {Block(of, Rectangle({2, 1}, {3, 3}), 0, 0.5)};
    EXPECT_EQ(At(map, 1.8, 2).obstruction, "") << "it touches";
    EXPECT_EQ(At(map, 1.81, 2).obstruction, "block");
    EXPECT_EQ(At(map, 2.5, 2).obstruction, "block") << "it is in it";
    EXPECT_NE(At(map, 2.5, 2).why.find("overlaps block"), std::string::npos);
    map.hazards[0].solids[0].z_low_m = 0.4;
    EXPECT_EQ(At(map, 2.5, 2).obstruction, "") << "over its head";
  }
}

TEST(StandAt, LowTerrainCarriesAWheelHighTerrainDoesNot) {
  HazardMap map = Room();
  map.hazards = {Block(HazardClass::kTerrain, Rectangle({1, 2.1}, {3, 2.2}), 0, 0.005)};
  EXPECT_EQ(At(map, 2, 2).obstruction, "");
  EXPECT_EQ(At(map, 2, 2).floor_m, 0);
  EXPECT_EQ(At(map, 2, 2).rests_m, 0.005);
  EXPECT_EQ(At(map, 2, 2.5).rests_m, 0) << "beside it";
  map.hazards[0].solids[0].z_high_m = 0.02;
  EXPECT_EQ(At(map, 2, 2).rests_m, 0.02);
  EXPECT_EQ(At(map, 2, 2.15).rests_m, 0) << "between its wheels, below its belly";
  EXPECT_EQ(At(map, 2, 2.15).obstruction, "");
  map.hazards[0].solids[0].z_high_m = 0.04;
  EXPECT_EQ(At(map, 2, 2).obstruction, "block");
}

TEST(StandAt, WallsAreAsBuilt) {
  HazardMap map = Room();
  for (int i = 0; i < 8; ++i) map.occupancy(4, i) = CellState::kOccupied;
  EXPECT_EQ(At(map, 1.8, 2).obstruction, "");
  EXPECT_EQ(At(map, 1.82, 2).obstruction, "wall");
  map.inset_m = 0.03;
  EXPECT_EQ(At(map, 1.82, 2).obstruction, "");
  EXPECT_EQ(At(map, 0.1, 2).obstruction, "wall") << "beyond the map";
}

TEST(StandAt, AMapTurnedAndMovedSaysTheSame) {
  const Pose2 X{3, -2, 0.7};
  HazardMap map = Room(), turned = Room();
  map.hazards = {Level(Rectangle({0, 2}, {4, 4}), 0.05),
                 Block(HazardClass::kGlass, Rectangle({1, 1}, {1.1, 1.5}), 0, 2)};
  turned.frame.X_WG = X;
  turned.hazards = map.hazards;
  for (Hazard& hazard : turned.hazards) {
    hazard.footprint[0] = InWorld(X, hazard.footprint[0]);
    hazard.solids[0].base = InWorld(X, hazard.solids[0].base);
  }
  for (double x = 0.3; x < 3.8; x += 0.23)
    for (double y = 0.3; y < 3.8; y += 0.23) {
      const Standing a = StandAt(map, Robot(), {x, y, 0.3});
      const Standing b = StandAt(turned, Robot(), X * Pose2{x, y, 0.3});
      EXPECT_EQ(a.floor_m, b.floor_m) << x << " " << y;
      EXPECT_EQ(a.obstruction, b.obstruction) << x << " " << y;
    }
}

// A robot of 0.8 m x 0.4 m in an aisle 0.7 m wide: it stands there along the aisle and not across,
// though it keeps a circle clear.
TEST(StandAt, ALongRobotIsJudgedByItsOutlineAtItsYaw) {
  RobotSpec robot = Robot();
  robot.outline_B = {Rectangle({-0.4, -0.2}, {0.4, 0.2})};
  robot.clear.radius_m = robot.circumscribed_radius_m = std::hypot(0.4, 0.2);
  HazardMap map;
  map.frame = {40, 9, 0.1, {}};
  map.occupancy = Grid<CellState>(40, 9);
  for (int ix = 0; ix < 40; ++ix)
    map.occupancy(ix, 0) = map.occupancy(ix, 8) = CellState::kOccupied;
  const auto why = [&](double y_m, double yaw_rad) {
    return StandAt(map, robot, {2, y_m, yaw_rad}).why;
  };
  EXPECT_EQ(why(0.45, 0), "");
  EXPECT_EQ(why(0.45, kPi), "");
  EXPECT_EQ(why(0.31, 0), "");
  EXPECT_EQ(why(0.45, kPi / 2), "overlaps a wall");
  EXPECT_EQ(why(0.45, 0.5), "overlaps a wall");
  EXPECT_EQ(why(0.29, 0), "overlaps a wall");
  map.hazards = {Block(HazardClass::kGlass, Rectangle({2.35, 0.4}, {2.36, 0.5}), 0, 2)};
  EXPECT_EQ(why(0.45, 0), "overlaps block, block");
}

}  // namespace
}  // namespace floorproof
