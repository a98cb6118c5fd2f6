// SPDX-License-Identifier: Apache-2.0
// How far along its path a robot is: a place, not a way driven.
#include "run/episode/plan_progress.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace floorproof {
namespace {

Path PathOf(const std::vector<Vec2>& points) {
  Path path;
  for (const Vec2& p : points) path.emplace_back().p_W = p;
  return path;
}

//  3--------2
//           |   the robot follows it, 1 m a leg but for the last, of 2 m
//  0--------1
const Path kPath = PathOf({{0, 0}, {1, 0}, {1, 1}, {-1, 1}});

TEST(PlanProgress, IsTheWayAlongThePathLessTheDistanceFromIt) {
  PlanProgress dut;
  EXPECT_EQ(dut.Update(kPath, 1, 0, {0, 0}), 0) << "it begins at none";
  EXPECT_DOUBLE_EQ(dut.Update(kPath, 1, 0, {0.5, 0}), 0.5);
  EXPECT_DOUBLE_EQ(dut.Update(kPath, 1, 0, {0.5, -0.2}), 0.3);
  EXPECT_DOUBLE_EQ(dut.Update(kPath, 1, 0, {0.25, 0}), 0.25) << "back";
  EXPECT_DOUBLE_EQ(dut.Update(kPath, 1, 1, {1, 0.5}), 1.5);
  EXPECT_DOUBLE_EQ(dut.Update(kPath, 1, 2, {-1, 1}), 4);
}

TEST(PlanProgress, SwayingAndCirclingAddNothing) {
  PlanProgress dut;
  for (int i = 0; i <= 1000; ++i) {
    const double a = 0.1 * i;
    dut.Update(kPath, 1, 0, {0.5 + 0.05 * std::sin(a), 0.05 * std::cos(3 * a)});
    EXPECT_LT(dut.meters(), 0.56);
  }
}

TEST(PlanProgress, AnotherPathGoesOnFromWhatWasReached) {
  PlanProgress dut;
  dut.Update(kPath, 1, 0, {0, 0});
  dut.Update(kPath, 1, 1, {1, 0.5});
  const Path around = PathOf({{1, 0.3}, {2, 0.3}, {2, 1}, {1, 1}, {-1, 1}});
  EXPECT_DOUBLE_EQ(dut.Update(around, 2, 0, {1, 0.3}), 1.5);
  EXPECT_DOUBLE_EQ(dut.Update(around, 2, 0, {1.5, 0.3}), 2);
  EXPECT_DOUBLE_EQ(dut.Update(around, 2, 2, {1.5, 1}), 3.7);
}

TEST(PlanProgress, OfOnePointIsHowNearItIs) {
  PlanProgress dut;
  dut.Update(PathOf({{1, 0}}), 1, 0, {0, 0});
  EXPECT_DOUBLE_EQ(dut.Update(PathOf({{1, 0}}), 1, 0, {0.75, 0}), 0.75);
  const Path doubled = PathOf({{0, 0}, {0, 0}, {1, 0}});
  PlanProgress other;
  other.Update(doubled, 1, 0, {0, 0});
  EXPECT_DOUBLE_EQ(other.Update(doubled, 1, 1, {0.5, 0}), 0.5);
}

// On a finely drawn bend the way gained is the way along it.
TEST(PlanProgress, GrowsWithTheWayAlongAFineCurve) {
  std::vector<Vec2> points;
  for (int i = 0; i <= 300; ++i) points.push_back({std::sin(0.01 * i), 1 - std::cos(0.01 * i)});
  const Path curve = PathOf(points);
  PlanProgress dut;
  dut.Update(curve, 1, 0, {0, 0});
  for (std::size_t i = 0; i < 300; ++i) dut.Update(curve, 1, i, points[i + 1]);
  EXPECT_NEAR(dut.meters(), 3, 1e-3);
}

}  // namespace
}  // namespace floorproof
