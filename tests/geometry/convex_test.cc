// SPDX-License-Identifier: Apache-2.0
#include "env/geometry/convex.h"

#include <gtest/gtest.h>

namespace floorproof {
namespace {

Polygon Turned(Polygon polygon, const Pose2& by) {
  for (Vec2& p : polygon) p = by * p;
  return polygon;
}

TEST(Convex, DistancesAreThoseOfTheNearestPoints) {
  const Polygon a = Rectangle({0, 0}, {2, 1});
  EXPECT_NEAR(Separate(a, Rectangle({2.5, 0}, {3, 1})).distance_m, 0.5, 1e-12);
  const Separation corner = Separate(a, Rectangle({2.3, 1.4}, {3, 3}));
  EXPECT_NEAR(corner.distance_m, 0.5, 1e-12);
  EXPECT_NEAR((corner.place - Vec2(2.3, 1.4)).norm(), 0, 1e-12);
}

TEST(Convex, AnOverlapIsAsDeepAsTheSideIsClipped) {
  const Polygon a = Rectangle({0, 0}, {2, 1});
  EXPECT_NEAR(Separate(a, Rectangle({-5, 0.98}, {5, 3})).distance_m, -0.02, 2e-5);
  EXPECT_NEAR(Separate(a, Rectangle({0.5, -3}, {1.5, 3})).distance_m, -0.5, 2e-5);
  EXPECT_NEAR(Separate(a, Rectangle({0.9, 0.15}, {1.1, 0.2})).distance_m, -0.2, 2e-5);
}

TEST(Convex, HowDeepIsSaidAsFarAsItIsAsked) {
  const Polygon a = Rectangle({0, 0}, {2, 1}), b = Rectangle({-5, 0.98}, {5, 3});
  EXPECT_EQ(Separate(a, b, 0.01).distance_m, -0.01);
  EXPECT_NEAR(Separate(a, b, 0.03).distance_m, -0.02, 2e-5);
  EXPECT_EQ(Separate(a, b, 3).distance_m, Separate(a, b).distance_m);
  EXPECT_EQ(Separate(a, Rectangle({2.5, 0}, {3, 1}), 0.01).distance_m, 0.5);
}

TEST(Convex, TouchingIsNeitherApartNorOverlapping) {
  const Polygon a = Rectangle({0, 0}, {2, 1});
  EXPECT_NEAR(Separate(a, Rectangle({2, 0.2}, {3, 0.4})).distance_m, 0, 2e-5);
}

TEST(Convex, NothingDependsOnWhereAndHowTheyLie) {
  const Polygon a = Rectangle({-1, -0.5}, {1, 0.5});
  for (const double d_m : {-0.3, -0.02, -0.001, 0.001, 0.02, 0.7}) {
    const Polygon b = Rectangle({1 + d_m, -0.2}, {4, 0.3});
    for (int deg = 0; deg < 360; deg += 17) {
      const Pose2 X{30, -7, deg * kPi / 180};
      EXPECT_NEAR(Separate(Turned(a, X), Turned(b, X)).distance_m, d_m, 3e-5) << deg;
    }
  }
}

TEST(Convex, WhatTwoShareMayBeAnEdgeOrACorner) {
  const Polygon a = Rectangle({0, 0}, {1, 1});
  const auto shared = [&](const Vec2& low, const Vec2& high) {
    return ConvexIntersection(a, Rectangle(low, high));
  };
  EXPECT_NEAR(SignedArea(shared({0.5, 0.25}, {2, 0.75})), 0.25, 1e-8);
  EXPECT_NEAR(SignedArea(shared({-1, -1}, {2, 2})), 1, 1e-8);
  EXPECT_EQ(shared({1, 1}, {2, 2}).size(), 1u);
  EXPECT_TRUE(shared({1.001, 0}, {2, 1}).empty());
  double along_m = 0;
  for (const Vec2& p : shared({1, 0.25}, {2, 0.75})) {
    EXPECT_NEAR(p.x(), 1, 1e-8);
    along_m = std::max(along_m, p.y());
  }
  EXPECT_NEAR(along_m, 0.75, 1e-8);
  // A diamond that touches with its corner, as the last cross-section in a column's corner does.
  EXPECT_FALSE(ConvexIntersection(a, {{1, 0.5}, {1.5, 0}, {2, 0.5}, {1.5, 1}}).empty());
}

TEST(Convex, WhatIsSweptHoldsEveryPlaceOnTheWay) {
  const Polygon a = Rectangle({0, 0}, {0.4, 0.4});
  const Vec2 by(1, 0.3);
  const Polygon dut = SweptBy(a, by);
  for (double t = 0; t <= 1; t += 0.1)
    for (const Vec2& p : a) EXPECT_LT(SignedDistance(dut, p + t * by), 1e-9);
  // The square, and a band as wide as the square is across the way.
  EXPECT_NEAR(SignedArea(dut), 0.16 + 0.4 * (1 + 0.3), 1e-9);
}

}  // namespace
}  // namespace floorproof
