// SPDX-License-Identifier: Apache-2.0
// What a body passes over on its way, against points of the way and of the square.
#include "planners/online/extent.h"

#include <gtest/gtest.h>

#include <random>

namespace floorproof {
namespace {

// How deep the square's nearest point comes to lie in the extent, negative where it stays outside:
// on a fine grid of points along the way.
double Deepest(const Extent& extent, const Vec2& by, double half_side, const Vec2& way) {
  double most = -1e9;
  for (int i = 0; i <= 2000; ++i) {
    const Vec2 at = i / 2000.0 * way;
    const Vec2 low = by.array() - half_side, high = by.array() + half_side;
    const Vec2 nearest = at.cwiseMax(low).cwiseMin(high) - at;
    const double deep = extent.round ? extent.half_m.x() - nearest.norm()
                                     : (extent.half_m - nearest.cwiseAbs()).minCoeff();
    most = std::max(most, deep);
  }
  return most;
}

TEST(Extent, PassesOverASquareThatItsBodyTouchesOnTheWay) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-3, 3), side(0.1, 1), reach(0.5, 1.5);
  int passed = 0, not_passed = 0;
  for (int i = 0; i < 4000; ++i) {
    const Extent extent{{reach(random), reach(random)}, i % 2 == 0};
    const Vec2 by(place(random), place(random)),
        way = i % 7 == 0 ? Vec2(0, 0) : Vec2(place(random), place(random));
    const double half_side = side(random) / 2, slack = i % 3 == 0 ? 0.1 : 0;
    const double deep = Deepest(extent, by, half_side, way) - slack;
    if (std::abs(deep) < 0.005) continue;
    const bool passes = extent.PassesOverSquare(by, half_side, way, slack);
    EXPECT_EQ(passes, deep > 0) << i;
    if (way.isZero()) {
      EXPECT_EQ(extent.HoldsPartOf(by, half_side, slack), passes) << i;
    }
    ++(passes ? passed : not_passed);
  }
  EXPECT_GT(passed, 1000);
  EXPECT_GT(not_passed, 1000);
}

}  // namespace
}  // namespace floorproof
