// SPDX-License-Identifier: Apache-2.0
#include "run/plan_check/sharp_corners.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace floorproof {
namespace {

int Count(const std::vector<Vec2>& points, double turn_radius_m) {
  Path path;
  for (const Vec2& p : points) path.emplace_back().p_W = p;
  RobotSpec robot;
  robot.turn_radius_m = turn_radius_m;
  return CountSharpCorners(path, robot);
}

// A bend of this angle between legs of 2 m, its corner stated twice.
std::vector<Vec2> Bend(double angle_rad) {
  return {{0, 0}, {2, 0}, {2, 0}, {2 + 2 * std::cos(angle_rad), 2 * std::sin(angle_rad)}};
}

TEST(SharpCorners, AreThoseThatTheTightestArcPassesFarOff) {
  constexpr double kR_m = 0.2;
  const double limit_rad = 2 * std::acos(kR_m / (kR_m + 0.02));
  EXPECT_EQ(Count(Bend(limit_rad - 0.01), kR_m), 0);
  EXPECT_EQ(Count(Bend(limit_rad + 0.01), kR_m), 1);
  EXPECT_EQ(Count(Bend(-limit_rad - 0.01), kR_m), 1) << "to either side";
  EXPECT_EQ(Count(Bend(kPi), kR_m), 1) << "back the way it came";
  EXPECT_EQ(Count({{0, 0}, {2, 0}, {2, 1}, {0, 1}}, kR_m), 2);
}

TEST(SharpCorners, AreNoneOfARobotThatTurnsOnTheSpot) { EXPECT_EQ(Count(Bend(2), 0), 0); }

}  // namespace
}  // namespace floorproof
