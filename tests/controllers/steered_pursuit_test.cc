// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/controllers/driving.h"

namespace floorproof {
namespace {

const RobotSpec& Tricycle() {
  return *std::ranges::find_if(TestRobots(),
                               [](const RobotSpec& r) { return r.turn_radius_m > 0; });
}

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
