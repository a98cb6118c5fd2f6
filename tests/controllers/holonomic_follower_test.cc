// SPDX-License-Identifier: Apache-2.0
// A tracker that keeps the plan's yaw in whatever direction it moves.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/controllers/driving.h"

namespace floorproof {
namespace {

Path WithYaw(Path path, double yaw_rad) {
  for (Waypoint& waypoint : path) waypoint.yaw_rad = yaw_rad;
  return path;
}

Driven DriveDut(const Path& path, const DriveOptions& options = {}) {
  const auto dut = MakePlugin(Trackers(), "holonomic_follower", "controller");
  return DriveAlong(*dut, path, options, nullptr, HolonomicRobot());
}

double LargestYaw(const Driven& driven, double yaw_rad) {
  double largest = 0;
  for (const auto& step : driven.steps)
    largest = std::max(largest, std::abs(WrapAngle(step.X_WB.yaw_rad - yaw_rad)));
  return largest;
}

const Path kRows = MakePath({{0, 0}, {2, 0}, {2, 0.4}, {0, 0.4}, {0, 0.8}, {2, 0.8}});

TEST(HolonomicFollower, KeepsThePlansYawForwardSidewaysAndBack) {
  for (const double yaw_rad : {0.0, kPi / 2, -2.0}) {
    DriveOptions options;
    options.start = Pose2{0, 0, yaw_rad};
    const Driven driven = DriveDut(WithYaw(kRows, yaw_rad), options);
    ASSERT_TRUE(driven.done);
    EXPECT_LT(LargestYaw(driven, yaw_rad), 0.02);
    EXPECT_LT(driven.max_cross_track_m, 0.02);
    EXPECT_TRUE(driven.SegmentsNeverDecrease());
  }
}

TEST(HolonomicFollower, HeadsAlongTheWayWhereThePlanLeavesItOpen) {
  const Driven driven = DriveDut(MakePath({{0, 0}, {2, 0}, {2, 1.5}}));
  ASSERT_TRUE(driven.done);
  EXPECT_NEAR(driven.steps.back().X_WB.yaw_rad, kPi / 2, 0.05);
  EXPECT_LT(driven.max_cross_track_m, 0.02);
}

TEST(HolonomicFollower, TurnsToTheNextYawBeforeItLeavesTheCorner) {
  Path path = WithYaw(MakePath({{0, 0}, {1, 0}, {2, 0}}), 0);
  path[2].yaw_rad = kPi / 2;
  const Driven driven = DriveDut(path);
  ASSERT_TRUE(driven.done);
  for (const auto& step : driven.steps) {
    if (std::abs(step.X_WB.x_m - 1) < 0.05) continue;
    EXPECT_NEAR(step.X_WB.yaw_rad, step.X_WB.x_m < 1 ? 0 : kPi / 2, 0.05);
  }
}

TEST(HolonomicFollower, AShiftSidewaysIsTakenBackWithoutTurning) {
  DriveOptions options;
  bool pushed = false;
  options.push = [&](double t_s, Pose2& X_WB) {
    if (pushed || t_s < 4) return;
    pushed = true;
    X_WB.y_m += 0.2;
  };
  const Driven driven = DriveDut(WithYaw(MakePath({{0, 0}, {4, 0}}), 0), options);
  ASSERT_TRUE(driven.done);
  EXPECT_GT(driven.max_cross_track_m, 0.19);
  EXPECT_LT(driven.CrossTrackAfter(9), 0.02);
  EXPECT_LT(LargestYaw(driven, 0), 0.02);
}

TEST(HolonomicFollower, RoundsAPolygonWithHeldYawWithoutStopping) {
  std::vector<Vec2> circle;
  for (int i = 0; i <= 72; ++i)
    circle.push_back({std::sin(i * kPi / 36), 1 - std::cos(i * kPi / 36)});
  DriveOptions options;
  options.start = Pose2{0, 0, 0};
  const Driven driven = DriveDut(WithYaw(MakePath(circle), 0), options);
  ASSERT_TRUE(driven.done);
  EXPECT_LT(driven.max_cross_track_m, 0.03);
  EXPECT_LT(LargestYaw(driven, 0), 0.02);
  EXPECT_LT(driven.time_s, 1.15 * 2 * kPi / 0.25);
}

}  // namespace
}  // namespace floorproof
