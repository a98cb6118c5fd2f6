// SPDX-License-Identifier: Apache-2.0
#include "env/core/path.h"

#include <gtest/gtest.h>

namespace floorproof {
namespace {

Path Through(std::initializer_list<Vec2> points) {
  Path path;
  for (const auto& p : points) path.push_back({p, {}, {}, 0, 0});
  return path;
}

TEST(PathTest, LengthIsTheSumOfItsSegments) {
  EXPECT_DOUBLE_EQ(Length(Through({{0, 0}, {3, 4}, {3, 5}})), 6);
  EXPECT_DOUBLE_EQ(Length({}), 0);
}

TEST(PathTest, OnlySharpCornersAreTurns) {
  EXPECT_EQ(CountTurns(Through({{0, 0}, {1, 0}, {2, 0.05}, {3, 0.1}})), 0);
  EXPECT_EQ(CountTurns(Through({{0, 0}, {1, 0}, {1, 1}, {0, 1}})), 2);
  EXPECT_EQ(CountTurns(Through({{0, 0}, {1, 0}, {1, 0}, {2, 0}})), 0) << "a repeated point is none";
  EXPECT_EQ(CountTurns(Through({{0, 0}, {1, 0}, {0, 0}})), 1) << "turning back";
}

// X_AB * X_BC = X_AC, and a pose times its inverse is nothing.
TEST(Pose2Test, FramesCancel) {
  const Pose2 X_AB{1, 2, 0.7}, X_BC{-0.3, 0.4, 2.9};
  const Vec2 p_C(0.2, -0.1);
  const Vec2 direct = X_AB * (X_BC * p_C), composed = (X_AB * X_BC) * p_C;
  EXPECT_NEAR((direct - composed).norm(), 0, 1e-12);
  const Pose2 nothing = X_AB * X_AB.Inverse();
  EXPECT_NEAR(nothing.p().norm(), 0, 1e-12);
  EXPECT_NEAR(nothing.yaw_rad, 0, 1e-12);
}

}  // namespace
}  // namespace floorproof
