// SPDX-License-Identifier: Apache-2.0
// Each type's own geometry.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "tests/hazards/make_hazard.h"

namespace floorproof {
namespace {

const Polygon kL = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};  // 3 m^2
const std::vector<Vec2> kLine = {{0, 0}, {2, 0}};

TEST(StepTest, UpIsSolidDownIsMissingFloor) {
  const Hazard up = MakeOf("step", "{height_m: 0.1}", kL);
  const Hazard down = MakeOf("step", "{height_m: -0.1}", kL);
  EXPECT_NEAR(Volume(up), 0.3, 1e-12);
  EXPECT_NEAR(Volume(down), -0.3, 1e-12);
  EXPECT_EQ(up.hazard_class, HazardClass::kLevelChange);
  EXPECT_EQ(down.solids.at(0).kind, Solid::Kind::kCut);
  EXPECT_DOUBLE_EQ(down.solids.at(0).z_low_m, -0.1);
}

TEST(StepTest, AnObstacleOnlyBeyondTheRobotsStep) {
  for (const char* keys : {"{height_m: 0.02}", "{height_m: -0.02}"}) {
    const Hazard dut = MakeOf("step", keys, kL);
    EXPECT_TRUE(IsObstacle(dut, 0.019));
    EXPECT_FALSE(IsObstacle(dut, 0.021));
  }
}

TEST(BlindObjectTest, FillsItsPolygon) {
  const Hazard dut = MakeOf("blind_object", "{height_m: 0.5}", kL);
  EXPECT_NEAR(Volume(dut), 1.5, 1e-12);
  EXPECT_TRUE(IsObstacle(dut, 10));
}

TEST(GlassTest, IsAThinPaneOnItsLine) {
  const Hazard dut = MakeOf("glass", "{height_m: 2, thickness_m: 0.01}", kLine);
  EXPECT_EQ(dut.hazard_class, HazardClass::kGlass);
  EXPECT_NEAR(Volume(dut), 2 * 2 * 0.01, 1e-12);
  EXPECT_TRUE(Contains(dut.footprint.at(0), {1, 0.0049}));
  EXPECT_FALSE(Contains(dut.footprint.at(0), {1, 0.0051}));
  EXPECT_LT(dut.material.rgba[3], 1);  // one sees through it
}

TEST(GrooveTest, IsAsWideAndDeepAsSaid) {
  const Hazard dut = MakeOf("groove", "{width_m: 0.02, depth_m: 0.01}", kLine);
  EXPECT_NEAR(Volume(dut), -2 * 0.02 * 0.01, 1e-12);
  EXPECT_DOUBLE_EQ(dut.height_m, -0.01);
  EXPECT_FALSE(IsObstacle(dut, 0));  // terrain is driven over
}

TEST(CableCoverTest, IsATrapezoidInSection) {
  const Hazard dut =
      MakeOf("cable_cover", "{width_m: 0.13, top_width_m: 0.05, height_m: 0.02}", kLine);
  EXPECT_NEAR(Volume(dut), 2 * 0.02 * (0.13 + 0.05) / 2, 1e-12);
  // The flank's slope: 20 mm up over (130 - 50) / 2 mm.
  const Solid& s = dut.solids.at(0);
  const double run = s.top.at(0).y() - s.base.at(0).y();
  EXPECT_NEAR(std::atan2(s.z_high_m, run) * 180 / kPi, 26.565, 1e-3);
}

TEST(CableCoverTest, MitresAddUpToTheLengthOfTheLine) {
  // At a bend of 90 degrees the outer half gains what the inner loses.
  const Hazard dut = MakeOf("cable_cover", "{}", {{0, 0}, {2, 0}, {2, 1}});
  EXPECT_NEAR(Volume(dut), 3 * 0.02 * 0.09, 1e-12);
  EXPECT_EQ(dut.solids.size(), 2u);
}

TEST(CableCoverTest, ATopWiderThanItsFootIsRefused) {
  EXPECT_THROW(MakeOf("cable_cover", "{top_width_m: 0.2}", kLine), InputError);
}

TEST(RoughTest, BumpsStandApartUpToTheAmplitude) {
  const Hazard dut =
      MakeOf("rough", "{amplitude_m: 0.003, wavelength_m: 0.05}", Rectangle({0, 0}, {1, 1}));
  EXPECT_EQ(dut.solids.size(), 400u);
  double highest = 0, sum = 0;
  std::set<double> heights;
  for (const Solid& s : dut.solids) {
    highest = std::max(highest, s.z_high_m);
    sum += s.z_high_m;
    heights.insert(s.z_high_m);
    // Flanks are ramps: no steeper than the amplitude over the flank's run.
    EXPECT_NEAR(s.top.at(0).x() - s.base.at(0).x(), 0.225 * 0.05, 1e-12);
  }
  EXPECT_LE(highest, 0.003);
  EXPECT_GT(highest, 0.0029);
  EXPECT_NEAR(sum / 400, 0.003 * 0.65, 0.0001);  // uniform in [0.3, 1] of it
  EXPECT_GT(heights.size(), 390u);
  for (std::size_t i = 0; i < dut.solids.size(); ++i)
    for (std::size_t k = i + 1; k < dut.solids.size(); ++k) {
      const Vec2 d = (dut.solids[i].base[0] - dut.solids[k].base[0]).cwiseAbs();
      EXPECT_GE(d.maxCoeff(), 0.9 * 0.05);
    }
}

TEST(RoughTest, AreasThatTouchShareOneLattice) {
  const Hazard whole = MakeOf("rough", "{}", Rectangle({0, 0}, {2, 1}));
  const Hazard left = MakeOf("rough", "{}", Rectangle({0, 0}, {1, 1}));
  const Hazard right = MakeOf("rough", "{}", Rectangle({1, 0}, {2, 1}));
  EXPECT_EQ(left.solids.size() + right.solids.size(), whole.solids.size());
  EXPECT_NEAR(Volume(left) + Volume(right), Volume(whole), 1e-12);
}

TEST(RoughTest, BumpsStayWithinASlantedBorder) {
  const Polygon triangle = {{0, 0}, {2, 0}, {0, 2}};
  const Hazard dut = MakeOf("rough", "{wavelength_m: 0.07}", triangle);
  EXPECT_GT(dut.solids.size(), 300u);
  for (const Solid& s : dut.solids)
    for (const Vec2& p : s.base) EXPECT_LT(SignedDistance(triangle, p), 1e-9);
}

}  // namespace
}  // namespace floorproof
