// SPDX-License-Identifier: Apache-2.0
#include "planners/lines/held_yaw.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/planners/floors.h"

namespace floorproof {
namespace {

Shape2 Footprint(double length_m, double width_m) {
  const Vec2 corner(length_m / 2, width_m / 2);
  return {Shape2::Kind::kFootprint, 0, Rectangle(-corner, corner)};
}

double ExtentX(const Shape2& shape) {
  double extent = 0;
  for (const Vec2& p : shape.footprint_B) extent = std::max(extent, p.x());
  return extent;
}

TEST(HoldYaw, ACircleMayFaceAnywhere) {
  const HazardMap map = testing::EmptyFloor(40, 40, 0.1);
  const Shape2 disc{Shape2::Kind::kCircle, 0.2, {}};
  EXPECT_FALSE(HoldYaw(map, {2, 2, 1}, disc, disc).yaw_rad);
}

TEST(HoldYaw, TheStartsYawGoesToTheMapsNextQuarter) {
  HazardMap map = testing::EmptyFloor(40, 40, 0.1);
  map.frame.X_WG.yaw_rad = 0.2;
  for (const Shape2& shape : {Footprint(0.5, 0.5), Footprint(1, 0.25)}) {
    EXPECT_NEAR(*HoldYaw(map, {2, 2, 0.5}, shape, shape).yaw_rad, 0.2, 1e-12);
    EXPECT_NEAR(*HoldYaw(map, {2, 2, 1.2}, shape, shape).yaw_rad, 0.2 + kPi / 2, 1e-12);
  }
}

TEST(HoldYaw, ASquareMayTurnAndABarMayNot) {
  const HazardMap map = testing::EmptyFloor(40, 40, 0.1);
  const Shape2 square = Footprint(0.5, 0.5), bar = Footprint(1, 0.25);
  EXPECT_EQ(HoldYaw(map, {2, 2, 0}, square, square).yaws, Yaws::kQuarters);
  EXPECT_EQ(HoldYaw(map, {2, 2, 0}, bar, bar).yaws, Yaws::kFirst);
  EXPECT_NEAR(ExtentX(HoldYaw(map, {2, 2, 0}, bar, bar).clear), 0.5, 1e-12);
  EXPECT_NEAR(ExtentX(HoldYaw(map, {2, 2, kPi / 2}, bar, bar).tool), 0.125, 1e-12);
}

TEST(HoldYaw, ABarFitsThroughAGapLengthwiseOnly) {
  const HazardMap map = testing::Draw(R"(
      ########
      #......#
      ###..###
      #......#
      ########)",
                                      0.5);
  const Shape2 bar = Footprint(1.2, 0.25);
  const Pose2 along{1.2, 0.75, 0}, across{1.2, 0.75, kPi / 2};
  const auto area_m2 = [&](const Pose2& start) {
    const HeldShapes held = HoldYaw(map, start, bar, bar);
    return ComputeSweepArea(map, held.clear, held.tool, 0.01, start.p(), held.yaws).area_m2();
  };
  EXPECT_GT(area_m2(along), 1.0);
  EXPECT_LT(area_m2(along), 1.6);   // one room of 3 m x 0.5 m
  EXPECT_EQ(area_m2(across), 0.0);  // it does not fit there
}

}  // namespace
}  // namespace floorproof
