// SPDX-License-Identifier: Apache-2.0
// What films paint on the floor, as marks; no picture is drawn.
#include "render/film_floor.h"

#include <gtest/gtest.h>

#include <algorithm>
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
  const PaintedFloor level(nullptr);
  Trail trail(level, paint);
  trail.Add({0, 0, 0}, 0.3);
  trail.Add({1, 0, 0}, 0.3);
  const std::size_t swept = paint.geoms().size();
  const std::vector<FloorPatch> patches = {{5, {0, 0}, {0.5, 0}, 0.2, 0},
                                           {8, {0.5, 0}, {1, 0}, 0.2, 0.05}};
  SweptAgain dut(patches, level, paint);
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

// The height of a stripe's top at its ends.
std::array<double, 2> Tops(const mjvGeom& stripe) {
  const double half = static_cast<double>(stripe.size[0]) * static_cast<double>(stripe.mat[6]);
  const double top = static_cast<double>(stripe.pos[2]) + static_cast<double>(stripe.size[2]);
  return {top - half, top + half};
}

// From the floor up a ramp of 1 in 10 onto a platform: a plan's line, and what was driven, lie on
// each of them, straight along the way and across it.
TEST(FilmFloor, WhatIsPaintedLiesOnSlopesAndPlatforms) {
  HazardMap map;
  Hazard ramp, platform;
  ramp.hazard_class = HazardClass::kTerrain;
  ramp.solids = {{Solid::Kind::kPrism, Rectangle({1, -2}, {2, 2}), {}, 0, 0.1, {0.1, 0}}};
  platform.hazard_class = HazardClass::kLevelChange;
  platform.height_m = 0.1;
  platform.solids = {{Solid::Kind::kPrism, Rectangle({2, -2}, {4, 2}), {}, 0, 0.1}};
  map.hazards = {ramp, platform};
  const PaintedFloor floor(&map);
  FloorPaint plan;
  Path path(2);
  path[1].p_W = {3, 0};
  PaintPlan(path, 0.02, floor, plan);
  ASSERT_EQ(plan.geoms().size(), 3u) << "floor, ramp, platform";
  FloorPaint driven;
  Trail dut(floor, driven);
  for (double x = 0; x <= 3; x += 0.02) dut.Add({x, 0, std::clamp(0.1 * (x - 1), 0.0, 0.1)}, 0.3);
  EXPECT_LT(driven.geoms().size(), 12u) << "few stripes, with a disc each";
  for (const FloorPaint* paint : {&plan, &driven})
    for (const mjvGeom& mark : paint->geoms()) {
      if (mark.type != mjGEOM_BOX) continue;
      const auto ends = Ends(mark);
      const auto tops = Tops(mark);
      for (std::size_t i = 0; i < 2; ++i)
        EXPECT_NEAR(tops[i], std::clamp(0.1 * (ends[i].x() - 1), 0.0, 0.1), 0.008);
      const bool on_ramp = ends[0].x() > 0.98 && ends[1].x() < 2.02 && ends[0] != ends[1];
      if (on_ramp) {
        EXPECT_NEAR(mark.mat[2], -std::sin(std::atan(0.1)), 1e-3) << "tilted with it";
      }
    }
}

}  // namespace
}  // namespace floorproof
