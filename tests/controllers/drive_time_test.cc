// SPDX-License-Identifier: Apache-2.0
// What a plan will take, foretold: sums and orderings. How near drives come to it is told by
// polylines_test.cc.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/controllers/driving.h"
#include "tests/robots.h"

namespace floorproof {
namespace {

// By the tracker of this robot.
double Foretold(const Path& path, const RobotSpec& robot = RoundRobot()) {
  const auto dut = MakePlugin(Trackers(), DefaultTracker(robot.drive), "controller");
  dut->Start(path, robot, nullptr);
  return dut->Duration();
}

// 40 legs of 0.3 m, each at this angle to the one before, left and right in turn.
Path Zigzag(double turn_rad) {
  std::vector<Vec2> points = {{0, 0}};
  for (int i = 0; i < 40; ++i) {
    const double heading_rad = i % 2 * turn_rad;
    points.push_back(points.back() + 0.3 * Vec2(std::cos(heading_rad), std::sin(heading_rad)));
  }
  return MakePath(points);
}

TEST(DriveTime, OfALongStraightIsItsLengthByItsSpeed) {
  for (const double speed_mps : {0.002, 0.01, 0.1, 0.4}) {
    Path path = MakePath({{0, 0}, {20, 0}});
    path[1].speed_mps = speed_mps;
    const double least_s = 20 / speed_mps;
    EXPECT_GT(Foretold(path), least_s);
    EXPECT_LT(Foretold(path), least_s + 3);
  }
}

// Turned away from the way on, and back again.
TEST(DriveTime, FacingElsewhereAtAStopTakesTwoTurns) {
  Path path = MakePath({{0, 0}, {2, 0}, {4, 0}});
  path[1].dwell_s = 5;
  const double straight_s = Foretold(path);
  path[1].yaw_rad = 0;
  EXPECT_DOUBLE_EQ(Foretold(path), straight_s);
  double last_s = straight_s;
  for (const double yaw_rad : {0.5, 1.5, 3.0}) {
    path[1].yaw_rad = yaw_rad;
    EXPECT_GT(Foretold(path), last_s);
    last_s = Foretold(path);
  }
  path[1].yaw_rad = -1.5;
  Path right = path;
  right[1].yaw_rad = 1.5;
  EXPECT_DOUBLE_EQ(Foretold(path), Foretold(right));
  const RobotSpec robot = RoundRobot();
  EXPECT_GT(Foretold(path) - straight_s, 2 * 1.5 / robot.max_yaw_rate_radps);
}

// The share of the speed that is allowed falls with the gap, and the time is its inverse.
TEST(DriveTime, SlowingDownBesideObstaclesTakesTime) {
  for (const RobotSpec& robot : TestRobots()) {
    const Path path = MakePath({{2, 5}, {8, 5}});
    const auto foretold = [&](double distance_m) {
      ClearanceField field{{200, 200, 0.05, {}}, Grid<float>(200, 200)};
      for (float& d : field.distance_m.cells) d = static_cast<float>(distance_m);
      const auto dut = MakePlugin(Trackers(), DefaultTracker(robot.drive), "controller");
      dut->Start(path, robot, &field);
      return dut->Duration();
    };
    const double free_s = Foretold(path, robot);
    EXPECT_DOUBLE_EQ(foretold(2), free_s) << robot.name;
    // With no gap at all six tenths of the speed are left.
    EXPECT_NEAR(foretold(0), free_s + 6 / robot.cruise_mps * (1 / 0.6 - 1), 0.02 * free_s)
        << robot.name;
  }
}

TEST(DriveTime, TurnsTakeTime) {
  for (const RobotSpec& robot : TestRobots()) {
    if (robot.turn_radius_m > 0) continue;  // turns by no more than driving on
    double last_s = Foretold(Zigzag(0), robot);
    for (const double turn_rad : {0.5, 1.0, kPi / 2, 2.5, kPi}) {
      const double now_s = Foretold(Zigzag(turn_rad), robot);
      // Bends are driven through, at full speed where they are gentle.
      EXPECT_GE(now_s, last_s + (turn_rad > 0.9 ? 1 : -1e-6)) << robot.name << " " << turn_rad;
      last_s = now_s;
    }
    // 39 half turns, none faster than the robot can.
    EXPECT_GT(last_s, 39 * kPi / robot.max_yaw_rate_radps);
  }
}

TEST(DriveTime, HeldYawNeedsNoTurns) {
  Path path = Zigzag(kPi / 2);
  const double turned_s = Foretold(path, HolonomicRobot());
  for (Waypoint& waypoint : path) waypoint.yaw_rad = 0.3;
  EXPECT_LT(Foretold(path, HolonomicRobot()), turned_s - 39);
}

TEST(DriveTime, DwellsAddTheirTime) {
  Path path = Zigzag(kPi / 2);
  const double without_s = Foretold(path);
  path.front().dwell_s = 7;
  path[5].dwell_s = 100;
  path.back().dwell_s = 3;
  EXPECT_NEAR(Foretold(path), without_s + 110, 1e-6);
}

TEST(DriveTime, FoldingTakesTime) {
  for (const std::string& name : RobotNames()) {
    const RobotSpec robot = ReadRobot(FindRobotFile(name, {}), {}, Blocks::kHinged).spec;
    for (std::size_t i = 0; i < robot.shapes.size(); ++i) {
      Path path = MakePath({{0, 0}, {1, 0}, {2, 0}});
      const double without_s = Foretold(path, robot);
      path[2].shape = robot.shapes[i].name;
      const double folding_s = Foretold(path, robot) - without_s;
      if (static_cast<int>(i) == robot.shape) {
        EXPECT_LT(folding_s, 2) << "it has that shape, and stops to find so";
      } else {
        EXPECT_GT(folding_s, kPi / 2 / 0.35) << "a quarter turn of a hinge at least";
        EXPECT_LT(folding_s, 120);
      }
    }
  }
}

TEST(DriveTime, OfNothingIsNone) {
  EXPECT_EQ(Foretold({}), 0);
  EXPECT_EQ(Foretold(MakePath({{1, 2}})), 0);
  EXPECT_EQ(Foretold(MakePath({{1, 2}, {1, 2}})), 0);
}

}  // namespace
}  // namespace floorproof
