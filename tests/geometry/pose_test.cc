// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "env/geometry/geometry.h"
#include "env/geometry/grid.h"

namespace floorproof {
namespace {

constexpr double kYaws_rad[] = {0, -0.0, 1e-12, 0.3, kPi / 2, -kPi / 2, 2.5, -3.1, kPi};
const Vec2 kPoints[] = {{0, 0}, {1, 0}, {0, -2}, {-3.25, 7.5}};

TEST(Pose2, TurnsAgainstTheClock) {
  const Vec2 turned = Pose2{1, 2, kPi / 2} * Vec2(3, 0);
  EXPECT_NEAR(turned.x(), 1, 1e-15);
  EXPECT_NEAR(turned.y(), 5, 1e-15);
  EXPECT_EQ((Pose2{1, 2, 0} * Vec2(3, -4)), Vec2(4, -2));
}

TEST(Pose2, ItsInverseTakesBack) {
  for (const double yaw_rad : kYaws_rad)
    for (const Vec2& p : kPoints) {
      const Pose2 X{-1.5, 4, yaw_rad};
      EXPECT_LT((X.Inverse() * (X * p) - p).norm(), 1e-14) << yaw_rad;
      EXPECT_LT((X.InverseTimes(X * p) - p).norm(), 1e-14) << yaw_rad;
      EXPECT_LT((X * X.InverseTimes(p) - p).norm(), 1e-14) << yaw_rad;
    }
}

TEST(GridFrame, ACellHoldsItsCentre) {
  for (const double yaw_rad : kYaws_rad) {
    const GridFrame frame{40, 30, 0.05, {-1.5, 4, yaw_rad}};
    for (const Cell cell : {Cell{0, 0}, Cell{39, 29}, Cell{-3, 12}})
      EXPECT_EQ(frame.ToCell(frame.Center(cell)), cell) << yaw_rad;
  }
}

}  // namespace
}  // namespace floorproof
