// SPDX-License-Identifier: Apache-2.0
#include "env/geometry/polygon.h"

#include <gtest/gtest.h>

#include <cmath>

namespace floorproof {
namespace {

constexpr double kRounding_m2 = 1e-6;

double TotalArea(const std::vector<Polygon>& parts) {
  double area = 0;
  for (const auto& part : parts) area += SignedArea(part);
  return area;
}

TEST(Polygon, SignedDistanceIsNegativeInside) {
  const Polygon square = Rectangle({0, 0}, {2, 2});
  EXPECT_DOUBLE_EQ(SignedDistance(square, {1, 1}), -1);
  EXPECT_DOUBLE_EQ(SignedDistance(square, {3, 3}), std::sqrt(2));
  EXPECT_TRUE(Contains(square, {2, 1}));
  EXPECT_FALSE(Contains(square, {2.001, 1}));
}

TEST(Polygon, AreasOfUnionAndDifferenceAddUp) {
  const Polygon a = Rectangle({0, 0}, {2, 2}), b = Rectangle({1, 1}, {3, 3});
  EXPECT_NEAR(Area(Union({a, b})), 7, kRounding_m2);
  EXPECT_NEAR(Area(Difference({Region{a, {}}}, {b})), 3, kRounding_m2);
  EXPECT_NEAR(Area(Intersection({Region{a, {}}}, {b})), 1, kRounding_m2);
  EXPECT_TRUE(Difference({Region{a, {}}}, {Rectangle({-1, -1}, {5, 5})}).empty());
}

// A floor with two pits: the parts are convex, do not overlap, miss the pits and leave nothing out.
TEST(Polygon, ConvexPartsTileARegionWithHoles) {
  const Polygon pit = Rectangle({2, 2}, {3, 4});
  const Polygon slanted = {{6, 2}, {8, 3}, {7, 5}, {5, 4}};
  const auto floor = Difference({Region{Rectangle({0, 0}, {10, 8}), {}}}, {pit, slanted});
  for (const double yaw : {0.0, 0.3, kPi / 2}) {
    const auto parts = ConvexParts(floor, yaw);
    EXPECT_NEAR(TotalArea(parts), 80 - 2 - SignedArea(slanted), kRounding_m2) << yaw;
    for (const auto& part : parts) EXPECT_TRUE(IsConvex(part));
    for (double x = 0.05; x < 10; x += 0.37)
      for (double y = 0.05; y < 8; y += 0.41) {
        int covered = 0;
        for (const auto& part : parts) covered += SignedDistance(part, {x, y}) < -1e-6;
        const bool in_pit = Contains(pit, {x, y}) || Contains(slanted, {x, y});
        EXPECT_LE(covered, in_pit ? 0 : 1) << x << ", " << y;
      }
  }
}

// Seams are what wheels feel: one rectangular pit needs four slabs and no more.
TEST(Polygon, OnePitMakesFourSlabs) {
  const auto floor =
      Difference({Region{Rectangle({0, 0}, {10, 8}), {}}}, {Rectangle({2, 2}, {3, 4})});
  EXPECT_EQ(ConvexParts(floor).size(), 4u);
}

TEST(Polygon, AConvexRegionStaysWhole) {
  const Polygon triangle = {{0, 0}, {3, 0}, {1, 2}};
  const auto parts = ConvexParts({Region{triangle, {}}});
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0], triangle);
}

TEST(Polygon, TheHullOfPointsHoldsThemAll) {
  const std::vector<Vec2> points = {{0, 0}, {2, 0}, {1, 0.5}, {2, 2}, {0, 2}, {1, 1}, {0, 0}};
  const Polygon hull = ConvexHull(points);
  EXPECT_EQ(hull.size(), 4u);
  EXPECT_GT(SignedArea(hull), 0);
  for (const auto& p : points) EXPECT_TRUE(Contains(hull, p));
}

TEST(Polygon, ABowTieIsNotSimple) {
  EXPECT_TRUE(IsSimple(Rectangle({0, 0}, {1, 1})));
  EXPECT_FALSE(IsSimple({{0, 0}, {1, 1}, {1, 0}, {0, 1}}));
}

}  // namespace
}  // namespace floorproof
