// SPDX-License-Identifier: Apache-2.0
#include "env/hazards/strip.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"

namespace floorproof {
namespace {

using ::testing::SizeIs;

TEST(StripTest, AStraightLineIsARectangle) {
  const auto dut = StripAlong({{1, 1}, {4, 5}}, 0.2, "w");
  ASSERT_THAT(dut, SizeIs(1));
  EXPECT_NEAR(SignedArea(dut[0]), std::sqrt(3. * 3 + 4 * 4) * 0.2, 1e-12);
}

//        +--+
//        |  |     the bend's quads share the edge from its outer to its inner corner
//   +----+  |
//   +-------+
TEST(StripTest, NeighboursMeetOnTheBisector) {
  const auto dut = StripAlong({{0, 0}, {2, 0}, {2, 2}}, 0.2, "w");
  ASSERT_THAT(dut, SizeIs(2));
  const Vec2 outer(2.1, -0.1), inner(1.9, 0.1);
  EXPECT_LT((dut[0][1] - outer).norm(), 1e-12);
  EXPECT_LT((dut[0][2] - inner).norm(), 1e-12);
  EXPECT_LT((dut[1][0] - outer).norm(), 1e-12);
  EXPECT_LT((dut[1][3] - inner).norm(), 1e-12);
}

TEST(StripTest, QuadsAreConvexAndDoNotOverlap) {
  const auto dut = StripAlong({{0, 0}, {1, 0.2}, {1.5, 1}, {1, 2}, {1.2, 3}}, 0.1, "w");
  double sum = 0;
  for (const Polygon& quad : dut) {
    EXPECT_TRUE(IsConvex(quad));
    sum += SignedArea(quad);
  }
  EXPECT_NEAR(Area(Union(dut)), sum, 1e-9);
}

TEST(StripTest, ReversedLineSameGround) {
  const std::vector<Vec2> line = {{0, 0}, {1, 0.5}, {2, 0}}, back(line.rbegin(), line.rend());
  const auto a = StripAlong(line, 0.1, "w"), b = StripAlong(back, 0.1, "w");
  EXPECT_NEAR(Area(Intersection({{a[0], {}}, {a[1], {}}}, b)), Area(Union(a)), 1e-9);
}

TEST(StripTest, BendsThatCannotBeMitredAreRefused) {
  EXPECT_THROW(StripAlong({{0, 0}, {1, 0}, {0, 0.01}}, 0.1, "w"), InputError);
  EXPECT_THROW(StripAlong({{0, 0}, {0.02, 0}, {0.02, 1}}, 0.1, "w"), InputError);
}

}  // namespace
}  // namespace floorproof
