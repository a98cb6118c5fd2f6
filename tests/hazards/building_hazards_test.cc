// SPDX-License-Identifier: Apache-2.0
// What buildings hold: the shapes of thresholds, carpets, lifts, ramps and wet patches.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/hazards/make_hazard.h"

namespace floorproof {
namespace {

using ::testing::HasSubstr;

template <class Act>
std::string WhyRefused(const Act& act) {
  try {
    act();
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

const Polygon kL = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};

// The height of what stands at this place, over the base floor; 0 where nothing does.
double HeightAt(const Hazard& hazard, const Vec2& p) {
  double height_m = 0;
  for (const Solid& s : hazard.solids)
    if (s.kind == Solid::Kind::kPrism && Contains(s.base, p))
      height_m = std::max(height_m, IsSlope(s) ? TopAt(s, p) : s.z_high_m);
  return height_m;
}

TEST(Threshold, IsUprightAtItsEdgesAndBevelledAbove) {
  const Hazard dut = MakeOf("threshold", "{height_m: 0.013}", {{1, 2}, {1.9, 2}});
  ASSERT_EQ(dut.solids.size(), 2u);
  EXPECT_EQ(dut.solids[0].z_high_m, 0.0064);
  EXPECT_NEAR(SignedArea(dut.solids[1].top) / 0.9, 0.1 - 2 * 2 * (0.013 - 0.0064), 1e-12);
  EXPECT_EQ(MakeOf("threshold", "{height_m: 0.005}", {{1, 2}, {1.9, 2}}).solids.size(), 1u);
  EXPECT_EQ(MakeOf("threshold", "{bevel: 0}", {{1, 2}, {1.9, 2}}).solids.size(), 1u);
  EXPECT_EQ(MakeOf("threshold", "{vertical_m: 0}", {{1, 2}, {1.9, 2}}).solids.size(), 1u);
  EXPECT_FALSE(IsObstacle(dut, 0.013));
  EXPECT_TRUE(IsObstacle(dut, 0.012));
  EXPECT_THAT(WhyRefused([] {
                MakeOf("threshold", "{height_m: 0.05}", {{1, 2}, {1.9, 2}});
              }),
              HasSubstr("leaves no top"));
}

// A prism less what the slopes take: for a rectangle a x b with slopes of run w, the prismoid.
TEST(Carpet, SlopesInAllRoundItsEdge) {
  const Hazard flat = MakeOf("carpet", "{height_m: 0.01, bevel: 0}", kL);
  EXPECT_NEAR(Volume(flat), 3 * 0.01, 1e-12);
  const double a = 2, b = 1, w = 0.02, h = 0.01;
  const Hazard box = MakeOf("carpet", "{height_m: 0.01, bevel: 2}", Rectangle({0, 0}, {a, b}));
  EXPECT_NEAR(Volume(box), h * (a * b - w * (a + b) + 4 * w * w / 3), 1e-12);
  // An L: five corners turn in, one turns out, and its slopes meet at each.
  const Hazard dut = MakeOf("carpet", "{height_m: 0.01, bevel: 2}", kL);
  const double rim = 8 * w / 2 - 5 * (w * w / 3) + 1 * (w * w / 3);
  EXPECT_NEAR(Volume(dut), h * (3 - rim), 1e-12);
  EXPECT_GT(dut.material.rolling_drag, 0);
}

TEST(Carpet, ABevelForWhichThereIsNoRoomIsRefused) {
  EXPECT_THAT(WhyRefused([] { MakeOf("carpet", "{height_m: 0.05, bevel: 11}", kL); }),
              HasSubstr("bevel = 11: makes a slope of 0.55 m"));
}

TEST(LiftSill, IsAGapAndAFloorBehindIt) {
  const Polygon car = {{0, 0}, {1.1, 0}, {1.1, 1.4}, {0, 1.4}};
  const Hazard level = MakeOf("lift_sill", "{gap_m: 0.03}", car);
  EXPECT_EQ(level.hazard_class, HazardClass::kTerrain);
  EXPECT_NEAR(Volume(level), -1.1 * 0.03 * 0.05, 1e-12);
  const Hazard high = MakeOf("lift_sill", "{gap_m: 0.03, level_m: 0.01}", car);
  EXPECT_EQ(high.hazard_class, HazardClass::kLevelChange);
  EXPECT_NEAR(Volume(high), 1.1 * 1.37 * 0.01 - 1.1 * 0.03 * 0.05, 1e-12);
  EXPECT_EQ(HeightAt(high, {0.5, 0.02}), 0);
  EXPECT_EQ(HeightAt(high, {0.5, 0.04}), 0.01);
  const Hazard low = MakeOf("lift_sill", "{gap_m: 0.03, level_m: -0.01}", car);
  EXPECT_NEAR(Volume(low), -1.1 * 1.37 * 0.01 - 1.1 * 0.03 * 0.05, 1e-12);
}

TEST(LiftSill, ACarThatDoesNotHoldItsGapIsRefused) {
  EXPECT_THAT(WhyRefused([] {
                MakeOf("lift_sill", "{gap_m: 0.2}", {{0, 0}, {1, 0}, {0.5, 0.9}});
              }),
              HasSubstr("must hold the whole gap along its first edge"));
  EXPECT_THAT(WhyRefused([] {
                MakeOf("lift_sill", "{depth_m: 0.02, level_m: -0.02}", Rectangle({0, 0}, {1, 1}));
              }),
              HasSubstr("depth_m"));
}

TEST(Ramp, RisesFromItsFirstCornersWhateverItsShape) {
  const double rise = std::tan(10 * kPi / 180);
  const Hazard along_x = MakeOf("ramp", "{slope_deg: 10}", kL);
  for (const Vec2& p : {Vec2(0.5, 0.5), Vec2(1.7, 0.3), Vec2(0.2, 1.9)})
    EXPECT_NEAR(HeightAt(along_x, p), rise * p.x(), 1e-12);
  // The middle of the L's area lies 5/6 m from either arm's foot.
  EXPECT_NEAR(Volume(along_x), 3 * rise * 5.0 / 6, 1e-12);
  EXPECT_NEAR(along_x.height_m, 2 * rise, 1e-12);
  const Hazard askew = MakeOf("ramp", "{slope_deg: 10, toward_deg: 225}", kL);
  const double first = -std::sqrt(0.5) * 3;  // of (2, 1) and (1, 2) along that direction
  for (const Vec2& p : {Vec2(0.5, 0.5), Vec2(1.7, 0.3)})
    EXPECT_NEAR(HeightAt(askew, p), rise * (-std::sqrt(0.5) * (p.x() + p.y()) - first), 1e-12);
}

TEST(Ramp, FallsBelowTheFloorAsItRisesAboveIt) {
  const Hazard up = MakeOf("ramp", "{slope_deg: 10}", kL);
  const Hazard down = MakeOf("ramp", "{slope_deg: -10}", kL);
  EXPECT_EQ(down.height_m, -up.height_m);
  EXPECT_NEAR(Volume(down), -Volume(up), 1e-12);
  EXPECT_THAT(WhyRefused([] { MakeOf("ramp", "{slope_deg: 0}", kL); }), HasSubstr("slope_deg"));
}

TEST(Wet, IsASurfaceOfNoHeight) {
  const Hazard dut = MakeOf("wet", "{}", kL);
  ASSERT_EQ(dut.solids.size(), 1u);
  EXPECT_EQ(dut.solids[0].kind, Solid::Kind::kSurface);
  EXPECT_EQ(dut.hazard_class, HazardClass::kTerrain);
  EXPECT_EQ(dut.material.friction, 0.4);
}

}  // namespace
}  // namespace floorproof
