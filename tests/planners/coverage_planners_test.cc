// SPDX-License-Identifier: Apache-2.0
// The two planners of a known floor, on floors where the right answer is obvious.
#include <gtest/gtest.h>

#include <map>

#include "tests/planners/floors.h"

namespace floorproof {
namespace {

using testing::Coverage;
using testing::DiscRobot;
using testing::Draw;
using testing::EmptyFloor;
using testing::ExpectSound;
using testing::MakePlanner;
using testing::RoomOnFloor;

PlanResult Plan(const std::string& name, const std::string& yaml, const HazardMap& map,
                const RobotSpec& robot, const Pose2& start) {
  PlanResult plan = MakePlanner(name, yaml)->Plan({map, robot, start, std::nullopt, 1});
  ExpectSound(map, start, plan);
  return plan;
}

double Figure(const PlanResult& plan, const std::string& name) {
  for (const auto& [key, value] : plan.figures)
    if (key == name) return value;
  ADD_FAILURE() << "no figure " << name;
  return 0;
}

// Length driven at direction `yaw` (to 5 deg) over all length.
double ShareAlong(const Path& path, double yaw_rad) {
  double along = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vec2 d = path[i].p_W - path[i - 1].p_W;
    const double off = std::remainder(std::atan2(d.y(), d.x()) - yaw_rad, kPi);
    if (std::abs(off) < 5 * kPi / 180) along += d.norm();
  }
  return along / Length(path);
}

TEST(Boustrophedon, AnOpenHallCostsLittleMoreThanItsArea) {
  const HazardMap map = EmptyFloor(240, 160, 0.05);  // 12 m x 8 m
  const RobotSpec robot = DiscRobot(0.18, 0.3);
  const Pose2 start{0.5, 0.5, 0};
  const PlanResult plan = Plan("boustrophedon", "{overlap: 0}", map, robot, start);
  EXPECT_GE(Coverage(map, robot, start, plan), 0.97);
  EXPECT_LE(Length(plan.path), 1.08 * 12 * 8 / 0.3);
  EXPECT_EQ(Figure(plan, "regions"), 1);
  EXPECT_EQ(Figure(plan, "cells"), 1);
  EXPECT_NEAR(Figure(plan, "rows"), 27, 1);
}

TEST(Boustrophedon, RowsRunAlongTheLongerSide) {
  const RobotSpec robot = DiscRobot(0.18, 0.3);
  const Pose2 start{0.5, 0.5, 0};
  const PlanResult wide = Plan("boustrophedon", "{}", EmptyFloor(200, 60, 0.05), robot, start);
  const PlanResult tall = Plan("boustrophedon", "{}", EmptyFloor(60, 200, 0.05), robot, start);
  EXPECT_GT(ShareAlong(wide.path, 0), 0.85);
  EXPECT_GT(ShareAlong(tall.path, kPi / 2), 0.85);
  EXPECT_NEAR(CountTurns(wide.path), CountTurns(tall.path), 4);
}

TEST(Boustrophedon, RowsFollowWallsThatStandAskew) {
  // A room of 10 m x 3 m turned by 30 deg against the map's cells.
  const Pose2 X_WR{1.9, 1.0, kPi / 6};
  const HazardMap map = RoomOnFloor(240, 200, 0.05, X_WR, [](const Vec2& p) {
    return p.x() >= 0 && p.x() <= 10 && p.y() >= 0 && p.y() <= 3;
  });
  const Vec2 p = X_WR * Vec2(1, 1);
  const PlanResult plan = Plan("boustrophedon", "{}", map, DiscRobot(0.18, 0.3), {p.x(), p.y(), 0});
  EXPECT_GT(ShareAlong(plan.path, kPi / 6), 0.8);
  EXPECT_NEAR(Figure(plan, "sweep_direction_deg"), 30, 3);
}

TEST(Boustrophedon, AGivenDirectionIsKept) {
  const HazardMap map = EmptyFloor(160, 120, 0.05);
  for (const double deg : {0.0, 37.0, 90.0, -45.0}) {
    const PlanResult plan = Plan("boustrophedon", "{direction_deg: " + FormatDouble(deg) + "}", map,
                                 DiscRobot(0.18, 0.3), {4, 3, 0});
    EXPECT_GT(ShareAlong(plan.path, deg * kPi / 180), 0.7) << deg;
  }
}

TEST(Boustrophedon, TheDirectionTurnsWithTheMapsFrame) {
  HazardMap map = EmptyFloor(200, 60, 0.05);
  map.frame.X_WG = {3, -4, 1.1};
  const Vec2 p = map.frame.X_WG * Vec2(1, 1);
  const PlanResult plan = Plan("boustrophedon", "{}", map, DiscRobot(0.18, 0.3), {p.x(), p.y(), 0});
  EXPECT_GT(ShareAlong(plan.path, 1.1), 0.85);
}

class Both : public ::testing::TestWithParam<std::string> {};

const char kFlat[] = R"(
  ####################
  #......#...........#
  #......#...........#
  #..................#
  #......#.....##....#
  #......#.....##....#
  ###.####...........#
  #......#...........#
  #......#...........#
  ####################)";

TEST_P(Both, EdgesSweepMoreOfTheFloor) {
  const HazardMap map = Draw(kFlat, 0.5);
  const RobotSpec robot = DiscRobot(0.18, 0.3);
  const Pose2 start{1, 1, 0};
  const PlanResult without = Plan(GetParam(), "{}", map, robot, start);
  const PlanResult with = Plan(GetParam(), "{edges: true}", map, robot, start);
  EXPECT_GE(Coverage(map, robot, start, without), 0.95);
  EXPECT_GE(Coverage(map, robot, start, with), 0.985);
  EXPECT_GT(Coverage(map, robot, start, with), Coverage(map, robot, start, without));
  EXPECT_GT(Figure(with, "laps_m"), 35);
  EXPECT_EQ(Figure(without, "laps_m"), 0);
}

TEST_P(Both, ANarrowerToolDrivesFartherAndSoDoesMoreOverlap) {
  const HazardMap map = Draw(kFlat, 0.5);
  const auto length = [&](const char* yaml) {
    return Length(Plan(GetParam(), yaml, map, DiscRobot(0.2, 0.3), {1, 1, 0}).path);
  };
  EXPECT_GT(length("{tool_width_m: 0.2}"), 1.2 * length("{tool_width_m: 0.3}"));
  EXPECT_GT(length("{overlap: 0.4}"), 1.2 * length("{overlap: 0}"));
}

TEST_P(Both, AnOverrideIsPlannedAndReported) {
  const HazardMap map = Draw(kFlat, 0.5);
  const PlanResult plan =
      Plan(GetParam(), "{tool_width_m: 0.26, radius_m: 0.22}", map, DiscRobot(0.1, 0.5), {1, 1, 0});
  EXPECT_EQ(plan.tool_width_m, 0.26);
  EXPECT_EQ(plan.tool.radius_m, 0.13);
  EXPECT_EQ(plan.clear.radius_m, 0.22);
}

TEST_P(Both, TransitsAreASmallPartOfAPlan) {
  const PlanResult plan = Plan(GetParam(), "{}", Draw(kFlat, 0.5), DiscRobot(0.18, 0.3), {1, 1, 0});
  EXPECT_GE(Figure(plan, "transit_m"), 0);
  EXPECT_LT(Figure(plan, "transit_m"), 0.2 * Length(plan.path));
}

TEST_P(Both, AToolFinerThanACellStillCovers) {
  const HazardMap map = EmptyFloor(20, 16, 0.05);
  const RobotSpec robot = DiscRobot(0.1, 0.04);
  const Pose2 start{0.5, 0.4, 0};
  EXPECT_GE(Coverage(map, robot, start, Plan(GetParam(), "{}", map, robot, start)), 0.95);
}

TEST_P(Both, AToolWiderThanTheRoomNeedsHardlyMove) {
  const HazardMap map = EmptyFloor(40, 40, 0.05);
  const RobotSpec robot = DiscRobot(0.2, 6.0);
  const Pose2 start{1, 1, 0};
  const PlanResult plan = Plan(GetParam(), "{}", map, robot, start);
  EXPECT_GE(Coverage(map, robot, start, plan), 0.95);
  EXPECT_LT(Length(plan.path), 3);
}

// Two rooms of 5 m x 6 m, joined by a door of 1.5 m, at this yaw to the map's cells.
HazardMap RoomsAt(double yaw_rad, Pose2& X_WR) {
  X_WR = {3.2, 1.2, yaw_rad};
  return RoomOnFloor(300, 240, 0.05, X_WR, [](const Vec2& p) {
    const bool is_inside = p.x() > 0 && p.x() < 10.2 && p.y() > 0 && p.y() < 6;
    const bool is_between = std::abs(p.x() - 5.1) < 0.1 && std::abs(p.y() - 3) > 0.75;
    return is_inside && !is_between;
  });
}

// A footprint holds the walls' direction, and its rows run along it. So a building that is askew to
// its map takes about as many turns, and as long a path, as one that is not.
TEST(Boustrophedon, AFootprintsRowsFollowWallsThatStandAskew) {
  RobotSpec robot = DiscRobot(0.25, 0.5);
  robot.clear = robot.tool = {Shape2::Kind::kFootprint, 0, Rectangle({-0.25, -0.25}, {0.25, 0.25})};
  const auto plan = [&](double yaw_rad, double start_yaw_rad) {
    Pose2 X_WR;
    const HazardMap map = RoomsAt(yaw_rad, X_WR);
    const Vec2 p = X_WR * Vec2(1, 1);
    const Pose2 start{p.x(), p.y(), start_yaw_rad};
    PlanResult result = Plan("boustrophedon", "{}", map, robot, start);
    EXPECT_GT(Coverage(map, robot, start, result), 0.94) << yaw_rad;
    return result;
  };
  const PlanResult straight = plan(0, 0);
  EXPECT_NEAR(*straight.path[1].yaw_rad, 0, 1e-9);
  constexpr double kYaw_deg = -20;
  const double yaw_rad = kYaw_deg * kPi / 180;
  const PlanResult dut = plan(yaw_rad, 0.1);
  EXPECT_NEAR(std::remainder(*dut.path[1].yaw_rad - yaw_rad, kPi / 2), 0, 0.01);
  EXPECT_GT(ShareAlong(dut.path, yaw_rad) + ShareAlong(dut.path, yaw_rad + kPi / 2), 0.75);
  EXPECT_LT(CountTurns(dut.path), 1.25 * CountTurns(straight.path));
  EXPECT_LT(Length(dut.path), 1.1 * Length(straight.path));
  EXPECT_NEAR(std::remainder(Figure(dut, "sweep_direction_deg") - kYaw_deg, 90), 0, 1);
  EXPECT_GE(Figure(dut, "sweep_direction_deg"), 0);
}

// Where the robot would reach into a wall at its start, held along the walls, it is not.
TEST(Boustrophedon, AFootprintIsNotHeldAlongWallsWhereItDoesNotFitAtTheStart) {
  RobotSpec robot = DiscRobot(0.25, 0.5);
  robot.clear = robot.tool = {Shape2::Kind::kFootprint, 0, Rectangle({-0.25, -0.25}, {0.25, 0.25})};
  Pose2 X_WR;
  HazardMap map = RoomsAt(-20 * kPi / 180, X_WR);
  const Vec2 middle = X_WR * Vec2(2.5, 3);
  const auto held = [&] {
    const PlanResult dut = Plan("boustrophedon", "{}", map, robot, {middle.x(), middle.y(), 0});
    return dut.path.empty() ? NAN : *dut.path[0].yaw_rad;
  };
  EXPECT_NEAR(std::remainder(held() + 20 * kPi / 180, kPi / 2), 0, 0.01);
  robot.outline_B = {Rectangle({-0.9, -0.02}, {0.9, 0.02})};  // sticks out beyond what plans keep
  const Vec2 ahead = X_WR * Vec2(2.5 + 0.85, 3);
  map.occupancy(map.frame.ToCell(ahead).ix, map.frame.ToCell(ahead).iy) = CellState::kOccupied;
  EXPECT_NEAR(std::remainder(held(), kPi / 2), 0, 1e-9);
}

// What a tool reaches behind a thin wall it does not sweep: both sides of the wall are driven
// along.
TEST_P(Both, AToolWiderThanItsRobotSweepsBothSidesOfAThinWall) {
  HazardMap map = EmptyFloor(120, 80, 0.05);
  for (int iy = 20; iy < 80; ++iy) map.occupancy(60, iy) = CellState::kOccupied;
  const RobotSpec robot = DiscRobot(0.15, 0.7);
  const Pose2 start{1, 1, 0};
  const PlanResult dut = Plan(GetParam(), "{}", map, robot, start);
  EXPECT_GT(Coverage(map, robot, start, dut), 0.96);
}

TEST_P(Both, AFootprintIsKeptClearAndCovers) {
  HazardMap map = Draw(R"(
    ########
    #......#
    #.##...#
    #......#
    ########)",
                       0.5);
  map.inset_m = 0.03;
  RobotSpec robot = DiscRobot(0.25, 0.5);
  robot.clear = robot.tool = {Shape2::Kind::kFootprint, 0, Rectangle({-0.25, -0.25}, {0.25, 0.25})};
  const Pose2 start{0.75, 0.75, 0};
  const PlanResult plan = MakePlanner(GetParam())->Plan({map, robot, start, std::nullopt, 1});
  ASSERT_EQ(plan.status, PlanStatus::kSuccess) << plan.message;
  EXPECT_GE(Coverage(map, robot, start, plan), 0.95);
  for (const Waypoint& w : plan.path) EXPECT_TRUE(w.yaw_rad.has_value());
  // A square that stays square to the walls: half its side, less the inset and a cell's half.
  EXPECT_GE(testing::LeastClearance(map, plan.path, 0.3), 0.25 - 0.03 - 0.025);
}

// A footprint that is long one way is planned for at the yaw that it starts with, and held there.
TEST_P(Both, ALongFootprintKeepsItsYaw) {
  const HazardMap map = EmptyFloor(12, 10, 0.5);
  RobotSpec robot = DiscRobot(0.25, 0.25);
  robot.clear = robot.tool = {Shape2::Kind::kFootprint, 0, Rectangle({-0.5, -0.125}, {0.5, 0.125})};
  for (const double yaw_rad : {0.0, kPi / 2}) {
    const Pose2 start{3, 2.5, yaw_rad};
    const PlanResult plan = MakePlanner(GetParam())->Plan({map, robot, start, std::nullopt, 1});
    ASSERT_EQ(plan.status, PlanStatus::kSuccess) << plan.message;
    EXPECT_GE(Coverage(map, robot, start, plan), 0.95);
    const bool along_y = yaw_rad > 0;
    for (const Waypoint& w : plan.path) {
      ASSERT_TRUE(w.yaw_rad.has_value());
      EXPECT_NEAR(*w.yaw_rad, yaw_rad, 1e-12);
      const double half_x = along_y ? 0.125 : 0.5, half_y = along_y ? 0.5 : 0.125;
      EXPECT_GE(std::min(w.p_W.x(), 6 - w.p_W.x()), half_x - 0.026) << "clear of the walls";
      EXPECT_GE(std::min(w.p_W.y(), 5 - w.p_W.y()), half_y - 0.026);
    }
  }
}

TEST_P(Both, AFootprintWithANotchIsRefused) {
  RobotSpec robot = DiscRobot(0.25, 0.25);
  robot.clear =
      robot.tool = {Shape2::Kind::kFootprint,
                    0,
                    {{-0.5, -0.25}, {0.5, -0.25}, {0.5, 0.25}, {0, 0.25}, {0, 0}, {-0.5, 0}}};
  const PlanResult plan =
      MakePlanner(GetParam())->Plan({EmptyFloor(12, 10, 0.5), robot, {3, 2.5, 0}, std::nullopt, 1});
  EXPECT_NE(plan.status, PlanStatus::kSuccess);
  EXPECT_NE(plan.message.find("not convex"), std::string::npos) << plan.message;
}

TEST_P(Both, AHugeMostlyUnknownMapIsNoHardship) {
  HazardMap map;
  map.frame = {2000, 2000, 0.05, {}};
  map.occupancy = Grid<CellState>(2000, 2000, CellState::kUnknown);
  for (int iy = 900; iy < 1000; ++iy)
    for (int ix = 1200; ix < 1290; ++ix) map.occupancy(ix, iy) = CellState::kFree;
  for (int i = 0; i < 2000; i += 7) map.occupancy(i, (i * 37) % 2000) = CellState::kFree;  // specks
  const RobotSpec robot = DiscRobot(0.18, 0.3);
  const Pose2 start{62, 47, 0};
  const PlanResult plan = Plan(GetParam(), "{}", map, robot, start);
  EXPECT_GE(Coverage(map, robot, start, plan), 0.95);
}

INSTANTIATE_TEST_SUITE_P(Planners, Both, ::testing::Values("boustrophedon", "spiral"));

}  // namespace
}  // namespace floorproof
