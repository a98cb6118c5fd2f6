// SPDX-License-Identifier: Apache-2.0
#include "env/geometry/polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/streams.h"

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

// Strips across one another, each replacing what it crosses, as floors do: their edges lie on one
// another but for rounding. Nothing is lost, and nothing is there twice.
TEST(Polygon, WhatIsPutTogetherAgainIsWhole) {
  const Polygon ground = Rectangle({-2, -2}, {6, 6});
  Stream draws(1, 0, "strips");
  for (int site = 0; site < 1000; ++site) {
    std::vector<Polygon> strips;
    for (std::uint64_t i = 0, n = 2 + draws.Below(4); i < n; ++i) {
      const double x_m = draws.Uniform(1, 3), y_m = draws.Uniform(1, 3);
      const double yaw_rad = draws.Below(2) == 0 ? 0 : draws.Uniform(-kPi, kPi);
      const Pose2 X{x_m, y_m, yaw_rad};
      const double length_m = draws.Uniform(0.3, 1), width_m = draws.Uniform(0.02, 0.15);
      strips.push_back(Rectangle({-length_m, -width_m / 2}, {length_m, width_m / 2}));
      for (Vec2& p : strips.back()) p = X * p;
    }
    std::vector<Polygon> pieces;
    double strips_m2 = 0;
    for (std::size_t i = 0; i < strips.size(); ++i) {
      const std::vector<Polygon> later(strips.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                                       strips.end());
      const std::vector<Region> whole = {{strips[i], {}}};
      const std::vector<Region> rest = Difference(whole, later);
      EXPECT_NEAR(Area(rest) + Area(Intersection(whole, later)), SignedArea(strips[i]),
                  kRounding_m2);
      for (const Polygon& part : ConvexParts(rest)) pieces.push_back(part);
      strips_m2 += Area(rest);
    }
    EXPECT_NEAR(Area(Union(strips)), strips_m2, kRounding_m2) << site;
    EXPECT_NEAR(Area(Union(pieces)), strips_m2, kRounding_m2) << site;
    const std::vector<Region> floor = Difference({Region{ground, {}}}, pieces);
    EXPECT_NEAR(Area(floor), 64 - strips_m2, kRounding_m2) << site;
    EXPECT_NEAR(TotalArea(ConvexParts(floor)), 64 - strips_m2, kRounding_m2) << site;
  }
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

// Cuts through corners that lie on one line but for rounding leave slabs of no width.
TEST(Polygon, NoPartIsASliver) {
  for (const double off_m : {1e-8, 1.5e-7, 5e-7, 2e-6}) {
    const Polygon pit = {{2, 2}, {7, 2 + off_m}, {7, 4}, {2, 4}};
    const auto parts = ConvexParts(Difference({Region{Rectangle({0, 0}, {10, 8}), {}}}, {pit}));
    EXPECT_NEAR(TotalArea(parts), 80 - SignedArea(pit), off_m > 1e-6 ? 1e-9 : 1e-5) << off_m;
    for (const Polygon& part : parts) {
      double longest_m = 0;
      for (const Vec2& p : part)
        for (const Vec2& q : part) longest_m = std::max(longest_m, (p - q).norm());
      EXPECT_GT(SignedArea(part), 0.9e-6 * longest_m) << off_m;
    }
    // What is left of a slab that another covers but for a strip.
    const std::vector<Region> strip =
        Difference({Region{Rectangle({0, 0}, {3, 1}), {}}}, {Rectangle({0, off_m}, {3, 2})});
    EXPECT_EQ(ConvexParts(strip).size(), off_m > 1e-6 ? 1u : 0u) << off_m;
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

// A round hole of many corners: fewer are left, the border hardly moves, sharp corners stay.
TEST(Polygon, SimplifiedKeepsTheBorderAndItsSharpCorners) {
  const Polygon square = Rectangle({-1, -1}, {1, 1});
  Polygon round = RegularPolygon(Vec2::Zero(), 0.1, 4000);
  std::ranges::reverse(round);
  const auto dut = Simplified({Region{square, {round}}}, 5e-5);
  ASSERT_EQ(dut.size(), 1u);
  EXPECT_EQ(dut[0].outer.size(), 4u);
  EXPECT_DOUBLE_EQ(SignedArea(dut[0].outer), 4);
  ASSERT_EQ(dut[0].holes.size(), 1u);
  EXPECT_LT(dut[0].holes[0].size(), 200u);
  EXPECT_LT(SignedArea(dut[0].holes[0]), 0) << "clockwise as before";
  for (const Vec2& p : round) EXPECT_LT(std::abs(SignedDistance(dut[0].holes[0], p)), 5e-5 + 1e-9);
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
