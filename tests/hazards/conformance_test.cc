// SPDX-License-Identifier: Apache-2.0
// What every registered hazard promises; a new one is tested by its line in list.inc.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "env/hazards/hazard_type.h"

namespace floorproof {
namespace {

class HazardConformance : public ::testing::TestWithParam<std::string> {
 protected:
  HazardConformance() : dut_(MakePlugin(HazardTypes(), GetParam(), "type")) {}
  // An L: not convex, so that types must cut it up; as a line it bends once.
  std::vector<Vec2> Place() const {
    if (dut_->placement() == HazardType::Placement::kLine) return {{0, 0}, {2, 0}, {2, 1}};
    return {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  }
  static bool Covers(const std::vector<Polygon>& polygons, const Vec2& p) {
    return std::ranges::any_of(polygons,
                               [&](const Polygon& q) { return SignedDistance(q, p) < 1e-9; });
  }
  static bool IsTopOfAPrism(const Hazard& hazard, double z_m) {
    return std::ranges::any_of(hazard.solids, [&](const Solid& s) {
      return s.kind == Solid::Kind::kPrism && s.z_high_m == z_m;
    });
  }
  std::unique_ptr<HazardType> dut_;
};

TEST_P(HazardConformance, DefaultsObeyTheirOwnRules) {
  ConfigNode node = ConfigNode::Map();
  WriteParams(*dut_, node);
  EXPECT_NO_THROW(ReadParams(node, "", *dut_));
  for (const ParamDoc& doc : DocumentParams(*dut_)) EXPECT_FALSE(doc.help.empty()) << doc.name;
}

TEST_P(HazardConformance, SolidsAreConvexAndLieInTheFootprint) {
  const Hazard hazard = dut_->Make(Place());
  ASSERT_FALSE(hazard.solids.empty());
  ASSERT_FALSE(hazard.footprint.empty());
  for (const Polygon& p : hazard.footprint) EXPECT_GT(SignedArea(p), 0);
  for (const Solid& s : hazard.solids) {
    EXPECT_GT(SignedArea(s.base), 0);
    if (s.kind == Solid::Kind::kSurface) {
      EXPECT_TRUE(IsSimple(s.base));
      EXPECT_EQ(s.z_low_m, s.z_high_m);
      continue;
    }
    EXPECT_LT(s.z_low_m, s.z_high_m);
    if (IsSlope(s)) {
      EXPECT_TRUE(s.top.empty());
      for (const Vec2& p : s.base) EXPECT_GE(TopAt(s, p), s.z_low_m - 1e-12);
    }
    if (s.kind == Solid::Kind::kCut) {
      EXPECT_TRUE(IsSimple(s.base));
      EXPECT_DOUBLE_EQ(s.z_high_m, 0);
    } else {
      EXPECT_TRUE(IsConvex(s.base));
      EXPECT_TRUE(s.z_low_m == 0 || IsTopOfAPrism(hazard, s.z_low_m)) << "it hangs in the air";
    }
    if (!s.top.empty()) {
      EXPECT_TRUE(IsConvex(s.top));
      EXPECT_EQ(s.top.size(), s.base.size());
      for (const Vec2& p : s.top) EXPECT_LT(SignedDistance(s.base, p), 1e-9);
    }
    for (const Vec2& p : s.base) EXPECT_TRUE(Covers(hazard.footprint, p));
  }
}

TEST_P(HazardConformance, NothingRisesOrFallsBeyondTheStatedHeight) {
  const Hazard hazard = dut_->Make(Place());
  const bool flat = std::ranges::all_of(
      hazard.solids, [](const Solid& s) { return s.kind == Solid::Kind::kSurface; });
  ASSERT_EQ(hazard.height_m == 0, flat);
  for (const Solid& s : hazard.solids) {
    EXPECT_GE(s.z_low_m, std::min(0.0, hazard.height_m));
    EXPECT_LE(s.z_high_m, std::max(0.0, hazard.height_m));
  }
}

TEST_P(HazardConformance, SamePlaceSameHazard) {
  const Hazard a = dut_->Make(Place());
  const Hazard b = MakePlugin(HazardTypes(), GetParam(), "type")->Make(Place());
  ASSERT_EQ(a.solids.size(), b.solids.size());
  for (std::size_t i = 0; i < a.solids.size(); ++i) {
    EXPECT_EQ(a.solids[i].base, b.solids[i].base);
    EXPECT_EQ(a.solids[i].z_high_m, b.solids[i].z_high_m);
  }
}

TEST_P(HazardConformance, MaterialIsPhysical) {
  const Material m = dut_->Make(Place()).material;
  EXPECT_GE(m.restitution, 0);
  EXPECT_LE(m.restitution, 1);
  EXPECT_GT(m.friction.value_or(1), 0);
  EXPECT_GT(m.rgba[3], 0);
}

INSTANTIATE_TEST_SUITE_P(Registry, HazardConformance,
                         ::testing::ValuesIn(PluginNames(HazardTypes())),
                         [](const auto& param) { return param.param; });

}  // namespace
}  // namespace floorproof
