// SPDX-License-Identifier: Apache-2.0
#include "env/geometry/box_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/streams.h"

namespace floorproof {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

// Boxes of a few centimetres to 8 m, some of which touch.
std::vector<Box2> RandomBoxes(int n) {
  Stream draw(2, 0, "boxes");
  std::vector<Box2> boxes;
  for (int i = 0; i < n; ++i) {
    const double step = 0.25;
    const Vec2 low(step * std::floor(draw.Uniform(-80, 80)),
                   step * std::floor(draw.Uniform(0, 99)));
    const double x = i % 20 == 0 ? 8 : draw.Uniform(0.03, 0.5);
    boxes.push_back({low, low + Vec2(x, i % 3 == 0 ? step : draw.Uniform(0.03, 0.5))});
  }
  return boxes;
}

TEST(BoxGrid, FindsWhatMeetsARectangleInOrderAndOnce) {
  const BoxGrid dut(RandomBoxes(500));
  Stream draw(2, 0, "rectangles");
  std::vector<int> found, expected;
  for (int k = 0; k < 300; ++k) {
    const Vec2 low(draw.Uniform(-25, 25), draw.Uniform(-5, 30));
    const Vec2 high = low + Vec2(draw.Uniform(0, 4), draw.Uniform(0, 4));
    expected.clear();
    for (int i = 0; i < 500; ++i) {
      const Box2& box = dut.boxes()[static_cast<std::size_t>(i)];
      if (box.low.x() <= high.x() && box.high.x() >= low.x() && box.low.y() <= high.y() &&
          box.high.y() >= low.y())
        expected.push_back(i);
    }
    dut.Near(low, high, found);
    EXPECT_EQ(found, expected);
  }
}

TEST(BoxGrid, NoSquareMeetsMoreThanIsSaid) {
  const BoxGrid dut(RandomBoxes(500));
  Stream draw(2, 0, "squares");
  const double half_m = 0.8;
  const auto most = static_cast<std::size_t>(dut.MostNear(half_m));
  std::vector<int> found;
  std::size_t highest = 0;
  for (int k = 0; k < 3000; ++k) {
    const Vec2 p(draw.Uniform(-25, 25), draw.Uniform(-5, 30)), half(half_m, half_m);
    dut.Near(p - half, p + half, found);
    highest = std::max(highest, found.size());
  }
  EXPECT_LE(highest, most);
  EXPECT_LE(most, 2 * highest) << "and it is no idle bound";
}

// Against the plain way: all boxes, each by its faces.
TEST(BoxGrid, ARayMeetsTheFirstBoxOnItsWay) {
  const BoxGrid dut(RandomBoxes(500));
  Stream draw(2, 0, "rays");
  int met = 0;
  for (int k = 0; k < 3000; ++k) {
    const Vec2 p(draw.Uniform(-25, 25), draw.Uniform(-5, 30));
    const double yaw = k % 8 == 0 ? kPi / 2 * (k % 32) / 8 : draw.Uniform(-kPi, kPi);
    const Vec2 d(std::cos(yaw), std::sin(yaw));
    double expected = kNone;
    for (const Box2& box : dut.boxes())
      for (int axis = 0; axis < 2; ++axis)
        for (const double face : {box.low[axis], box.high[axis]}) {
          const double t = (face - p[axis]) / d[axis], across = p[1 - axis] + t * d[1 - axis];
          if (t >= 0 && t < expected && across >= box.low[1 - axis] && across <= box.high[1 - axis])
            expected = t;
        }
    const double range = dut.Cast(p, d, 12);
    if (expected <= 12) {
      ++met;
      EXPECT_NEAR(range, expected, 1e-9) << p.transpose() << " " << yaw;
    } else {
      EXPECT_EQ(range, kNone);
    }
  }
  EXPECT_GT(met, 1000);
}

TEST(BoxGrid, WithoutBoxesThereIsNothingToMeet) {
  const BoxGrid dut;
  std::vector<int> found = {1};
  dut.Near({0, 0}, {1, 1}, found);
  EXPECT_TRUE(found.empty());
  EXPECT_EQ(dut.Cast({0, 0}, {1, 0}, 10), kNone);
  EXPECT_EQ(dut.MostNear(1), 0);
}

}  // namespace
}  // namespace floorproof
