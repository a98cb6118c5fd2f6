// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "tests/controllers/driving.h"

namespace floorproof {
namespace {

const RobotSpec& Tricycle() { return TestRobot("scrubber"); }

Driven Drive(const Path& path, const DriveOptions& options = {}) {
  const auto dut = MakePlugin(Trackers(), "steered_pursuit", "controller");
  return DriveAlong(*dut, path, options, nullptr, Tricycle());
}

// Two rows, joined by a half circle of this radius.
Path Rows(double radius_m, double length_m = 2) {
  std::vector<Vec2> points = {{0, 0}, {length_m, 0}};
  constexpr int kPieces = 20;
  for (int k = 1; k <= kPieces; ++k) {
    const double a = kPi * k / kPieces;
    points.emplace_back(length_m + radius_m * std::sin(a), radius_m * (1 - std::cos(a)));
  }
  points.emplace_back(0, 2 * radius_m);
  return MakePath(points);
}

TEST(SteeredPursuit, KeepsToTheTurnsThatPlansHave) {
  const Driven dut = Drive(Rows(1.2 * Tricycle().turn_radius_m));
  ASSERT_TRUE(dut.done);
  EXPECT_LT(dut.max_cross_track_m, 0.03);
  EXPECT_LT((dut.steps.back().X_WB.p() - Vec2(0, 2.4 * Tricycle().turn_radius_m)).norm(), 0.03);
}

// It is told no arc that it cannot drive, but for what its yaw rate lags while it slows down; and
// it never goes back.
TEST(SteeredPursuit, AsksForArcsThatTheSteeringAllows) {
  for (const Path& path : {Rows(0.1), Rows(0.3), MakePath({{0, 0}, {2, 0}, {2, 2}, {0, 2}})}) {
    const Driven dut = Drive(path);
    ASSERT_TRUE(dut.done);
    for (const auto& step : dut.steps) {
      EXPECT_GE(step.twist.vx_mps, 0);
      EXPECT_FALSE(step.turning);
      if (step.twist.vx_mps < 0.05) continue;
      EXPECT_LE(std::abs(step.twist.wz_radps),
                1.3 * step.twist.vx_mps / Tricycle().turn_radius_m + 0.05)
          << step.t_s;
    }
  }
}

// As wide as its tightest circle, and it comes back to its way.
TEST(SteeredPursuit, PassesSharpCornersWide) {
  const Driven dut = Drive(MakePath({{0, 0}, {3, 0}, {3, 3}, {0, 3}}));
  ASSERT_TRUE(dut.done);
  EXPECT_TRUE(dut.SegmentsNeverDecrease());
  EXPECT_LT(dut.max_cross_track_m, 2 * Tricycle().turn_radius_m);
  EXPECT_LT((dut.steps.back().X_WB.p() - Vec2(0, 3)).norm(), 0.05);
}

TEST(SteeredPursuit, TurnsRoundWhereItFacesAway) {
  DriveOptions options;
  options.start = Pose2{0, 0, kPi};
  const Driven dut = Drive(MakePath({{0, 0}, {4, 0}}), options);
  ASSERT_TRUE(dut.done);
  double farthest_m = 0;
  for (const auto& step : dut.steps)
    farthest_m = std::max(farthest_m, DistanceToSegment({0, 0}, {4, 0}, step.X_WB.p()));
  EXPECT_LT(farthest_m, 4 * Tricycle().turn_radius_m);
  EXPECT_LT((dut.steps.back().X_WB.p() - Vec2(4, 0)).norm(), 0.03);
}

// The robot stands at the origin and faces along x. On its tightest turn it comes to every place of
// a circle of radius R around (0, R), and to none inside it. `share` of R away from that middle, at
// an angle of the turn.
Vec2 BesideTheStart(double share, double angle_rad, double side) {
  const double r_m = Tricycle().turn_radius_m;
  return {share * r_m * std::sin(angle_rad), side * r_m * (1 - share * std::cos(angle_rad))};
}

void MakeStop(Waypoint& waypoint) {
  waypoint.dwell_s = 1;
  waypoint.task = WaypointTask{.id = 7};
}

Driven DriveToStop(const Vec2& stop_W, bool goes_on) {
  Path path = MakePath({{0, 0}, stop_W});
  MakeStop(path[1]);
  if (goes_on) path.push_back(MakePath({{6, 0}})[0]);
  DriveOptions options;
  options.start = Pose2{};
  options.time_limit_s = 120;
  return Drive(path, options);
}

// How far off it was while it did what was to be done; none: it did not.
std::optional<double> DoneOff(const Driven& driven, const Vec2& stop_W) {
  std::optional<double> off_m;
  for (const auto& step : driven.steps)
    if (!step.tasks.empty()) off_m = std::max(off_m.value_or(0), (step.X_WB.p() - stop_W).norm());
  return off_m;
}

// Farther round, its fork turns too late.
TEST(SteeredPursuit, AStopOnItsTightestTurnOrOutsideIsDoneThere) {
  for (const double side : {1.0, -1.0})
    for (const double share : {1.0, 1.3})
      for (const double angle_rad : {0.5, 1.0, 1.5}) {
        const Vec2 stop_W = BesideTheStart(share, angle_rad, side);
        for (const bool goes_on : {true, false}) {
          const Driven dut = DriveToStop(stop_W, goes_on);
          ASSERT_TRUE(dut.done) << stop_W.transpose();
          EXPECT_EQ(dut.missed.count, 0) << stop_W.transpose();
          EXPECT_LT(DoneOff(dut, stop_W).value_or(1), 0.05) << stop_W.transpose();
        }
      }
}

TEST(SteeredPursuit, AStopInsideItsTightestTurnIsMissedAndPassed) {
  for (const double side : {1.0, -1.0})
    for (const double share : {0.0, 0.6})
      for (const double angle_rad : {0.5, 1.0, 2.0, 3.0}) {
        const Vec2 stop_W = BesideTheStart(share, angle_rad, side);
        for (const bool goes_on : {true, false}) {
          const Driven dut = DriveToStop(stop_W, goes_on);
          ASSERT_TRUE(dut.done) << stop_W.transpose();
          EXPECT_EQ(dut.missed.count, 1) << stop_W.transpose();
          EXPECT_EQ(dut.missed.end, !goes_on);
          EXPECT_EQ(dut.missed.first_W, stop_W);
          EXPECT_FALSE(DoneOff(dut, stop_W).has_value()) << stop_W.transpose();
          const Vec2 end_W = goes_on ? Vec2(6, 0) : dut.steps.back().X_WB.p();
          EXPECT_LT((dut.steps.back().X_WB.p() - end_W).norm(), 0.05);
        }
      }
}

// From where it rests at one stop to another, `stop_W`, and on, or not.
Driven DriveToSecondStop(const Vec2& stop_W, bool goes_on) {
  Path path = MakePath({{0, 0}, {2, 0}, stop_W});
  path[1].dwell_s = 1;
  MakeStop(path[2]);
  if (goes_on) path.push_back(MakePath({{5, 0}})[0]);
  DriveOptions options;
  options.time_limit_s = 60;
  return Drive(path, options);
}

TEST(SteeredPursuit, AStopBesideTheOneItRestsAtIsDoneThere) {
  for (const double angle_rad : {-2.5, -1.6, -0.8, 0.8, 1.6, 2.5, kPi})
    for (const bool goes_on : {true, false}) {
      const Vec2 stop_W = Vec2(2, 0) + 0.025 * Vec2(std::cos(angle_rad), std::sin(angle_rad));
      const Driven dut = DriveToSecondStop(stop_W, goes_on);
      ASSERT_TRUE(dut.done) << angle_rad;
      EXPECT_EQ(dut.missed.count, 0) << angle_rad;
      EXPECT_LT(DoneOff(dut, stop_W).value_or(1), 0.04) << angle_rad;
    }
}

// No loop comes before that.
TEST(SteeredPursuit, AStopBehindTheOneItRestsAtIsMissedAtOnce) {
  for (const double behind_m : {0.08, 0.2, 0.3})
    for (const bool goes_on : {true, false}) {
      const Driven dut = DriveToSecondStop({2 - behind_m, 0.001}, goes_on);
      ASSERT_TRUE(dut.done) << behind_m;
      EXPECT_EQ(dut.missed.count, 1) << behind_m;
      EXPECT_EQ(dut.missed.end, !goes_on);
      for (const auto& step : dut.steps)
        ASSERT_LT(std::abs(step.X_WB.yaw_rad), 0.1) << behind_m << " " << step.t_s;
      EXPECT_NEAR(dut.steps.back().X_WB.x_m, goes_on ? 5 : 2, 0.05);
    }
}

// To a stop at x 2 and on, pushed once, as soon as it is at `from_m`.
Driven DrivePushed(double from_m, const std::function<void(Pose2&)>& push) {
  Path path = MakePath({{0, 0}, {2, 0}, {6, 0}});
  MakeStop(path[1]);
  bool pushed = false;
  DriveOptions options;
  options.push = [&](double, Pose2& X_WB) {
    if (pushed || X_WB.x_m < from_m) return;
    pushed = true;
    push(X_WB);
  };
  return Drive(path, options);
}

// One that was run past is not turned back to: what is done, is done where it belongs.
TEST(SteeredPursuit, AStopThatItIsPushedBeyondIsMissed) {
  for (const double beyond_m : {0.0, 0.03, 0.08, 0.3}) {
    const Driven dut = DrivePushed(1.9, [&](Pose2& X_WB) { X_WB.x_m = 2 + beyond_m; });
    ASSERT_TRUE(dut.done);
    EXPECT_EQ(dut.missed.count, beyond_m > 0.05) << beyond_m;
    EXPECT_EQ(DoneOff(dut, {2, 0}).has_value(), beyond_m < 0.05) << beyond_m;
  }
}

// Beside it by less than its turn is wide, it goes on: it makes no loop that leads to no stop. From
// farther off it comes back to it.
TEST(SteeredPursuit, AStopThatItIsPushedBesideIsMissedWithoutALoop) {
  for (const double aside_m : {0.22, -0.22, 0.6, -0.6}) {
    const Driven dut = DrivePushed(1.97, [&](Pose2& X_WB) { X_WB = {1.995, aside_m, 0}; });
    ASSERT_TRUE(dut.done);
    const bool near = std::abs(aside_m) < 2 * Tricycle().turn_radius_m;
    EXPECT_EQ(dut.missed.count, near) << aside_m;
    EXPECT_EQ(DoneOff(dut, {2, 0}).has_value(), !near) << aside_m;
    EXPECT_LT(DoneOff(dut, {2, 0}).value_or(0), 0.05) << aside_m;
    double turned_rad = 0;
    for (const auto& step : dut.steps)
      turned_rad = std::max(turned_rad, std::abs(step.X_WB.yaw_rad));
    EXPECT_EQ(turned_rad < kPi / 2, near) << aside_m;
  }
}

TEST(SteeredPursuit, ForetellsItsTime) {
  const auto dut = MakePlugin(Trackers(), "steered_pursuit", "controller");
  const Path path = Rows(0.3, 5);
  dut->Start(path, Tricycle(), nullptr);
  const double foretold_s = dut->Duration();
  const Driven driven = DriveAlong(*dut, path, {}, nullptr, Tricycle());
  EXPECT_NEAR(driven.time_s, foretold_s, 0.1 * foretold_s);
}

}  // namespace
}  // namespace floorproof
