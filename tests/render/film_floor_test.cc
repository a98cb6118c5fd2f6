// SPDX-License-Identifier: Apache-2.0
// What films paint on the floor, as marks; no picture is drawn.
#include "render/film_floor.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace floorproof {
namespace {

// The ends of a stripe.
std::array<Vec2, 2> Ends(const mjvGeom& stripe) {
  const Vec2 middle(stripe.pos[0], stripe.pos[1]);
  const Vec2 half = static_cast<double>(stripe.size[0]) * Vec2(stripe.mat[0], stripe.mat[3]);
  return {middle - half, middle + half};
}

TEST(FilmFloor, TheWindowIsAClosedRingAroundItsPlaceAndMovesWithIt) {
  FloorPaint paint;
  WindowRing dut(1.5, 0.02, paint);
  const std::size_t n = paint.geoms().size();
  ASSERT_GE(n, 32u);
  for (const Vec2& place : {Vec2(2, 1), Vec2(-3, 0.5)}) {
    dut.Show(place);
    ASSERT_EQ(paint.geoms().size(), n) << "the same marks";
    for (std::size_t i = 0; i < n; ++i) {
      const auto ends = Ends(paint.geoms()[i]), next = Ends(paint.geoms()[(i + 1) % n]);
      EXPECT_NEAR((ends[0] - place).norm(), 1.5, 1e-5);
      EXPECT_LT((ends[1] - next[0]).norm(), 1e-5);
    }
  }
}

TEST(FilmFloor, WithoutAWindowThereIsNoRing) {
  FloorPaint paint;
  WindowRing dut(0, 0.02, paint);
  dut.Show({1, 1});
  EXPECT_TRUE(paint.geoms().empty());
}

TEST(FilmFloor, WhatIsSweptAgainLiesOverWhatWasSweptFromItsTimeOn) {
  FloorPaint paint;
  Trail trail(paint);
  trail.Add({0, 0, 0}, 0.3);
  trail.Add({1, 0, 0}, 0.3);
  const std::size_t swept = paint.geoms().size();
  const std::vector<FloorPatch> patches = {{5, {0, 0}, {0.5, 0}, 0.2, 0},
                                           {8, {0.5, 0}, {1, 0}, 0.2, 0.05}};
  SweptAgain dut(patches, paint);
  dut.Show(4.9);
  EXPECT_EQ(paint.geoms().size(), swept);
  dut.Show(5);
  ASSERT_EQ(paint.geoms().size(), swept + 1);
  dut.Show(20);
  dut.Show(30);
  ASSERT_EQ(paint.geoms().size(), swept + 2) << "each once";
  const auto top = [](const mjvGeom& g) { return g.pos[2] + g.size[2]; };
  for (std::size_t i = 0; i < swept; ++i)
    EXPECT_GT(top(paint.geoms()[swept]), top(paint.geoms()[i]));
  EXPECT_NEAR(top(paint.geoms()[swept + 1]) - top(paint.geoms()[swept]), 0.05, 2e-3) << "raised";
  EXPECT_FLOAT_EQ(paint.geoms()[swept].size[1], 0.1f) << "half of its width";
  EXPECT_NE(paint.geoms()[swept].rgba[2], paint.geoms()[0].rgba[2]);
}

}  // namespace
}  // namespace floorproof
