// SPDX-License-Identifier: Apache-2.0
// What is left of hazards where they overlap, against what the site says: the later one wins.
#include "env/map/lay_floors.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/streams.h"
#include "tests/hazards/make_hazard.h"

namespace floorproof {
namespace {

std::vector<Hazard> Laid(std::vector<Hazard> hazards) {
  std::vector<std::string> warnings;
  LayFloors(hazards, warnings);
  return hazards;
}

// The one of this type.
Hazard Laid(std::vector<Hazard> hazards, std::string_view type) {
  hazards = Laid(std::move(hazards));
  return *std::ranges::find(hazards, type, &Hazard::type);
}

// A cover along x from 0 to 2 m, 90 mm wide, 50 mm at its top, 20 mm high.
Hazard Cover(double yaw_rad = 0) {
  const Pose2 X{0, 0, yaw_rad};
  return MakeOf("cable_cover", "{width_m: 0.09, top_width_m: 0.05, height_m: 0.02}",
                {X * Vec2(0, 0), X * Vec2(2, 0)});
}
constexpr double kSection_m2 = 0.02 * (0.09 + 0.05) / 2;

// Height of the cover over its floor at a place beside its line.
double CoverHeight(double across_m) {
  return std::clamp((0.045 - std::abs(across_m)) / 0.02, 0.0, 1.0) * 0.02;
}

// Height of a solid's upper side over its lower one at this place; 0 beside it.
double HeightOf(const Solid& solid, const Vec2& p) {
  const Polygon& top = solid.top.empty() ? solid.base : solid.top;
  if (!Contains(solid.base, p)) return 0;
  if (Contains(top, p)) return solid.z_high_m - solid.z_low_m;
  double low = 0, high = 1;  // the highest cross-section that holds p: they shrink upwards
  for (int i = 0; i < 40; ++i) {
    const double share = (low + high) / 2;
    std::vector<Vec2> corners;
    for (const Vec2& a : solid.base)
      for (const Vec2& b : top) corners.push_back(a + share * (b - a));
    (Contains(ConvexHull(corners), p) ? low : high) = share;
  }
  return low * (solid.z_high_m - solid.z_low_m);
}
double TopAt(const Hazard& hazard, const Vec2& p) {
  double top_m = 0;
  for (const Solid& solid : hazard.solids)
    if (Contains(solid.base, p)) top_m = std::max(top_m, solid.z_low_m + HeightOf(solid, p));
  return top_m;
}

TEST(LayFloors, AGrooveAcrossACoverTakesItsOwnWidthAndNoMore) {
  for (const double at_m : {0.3, 1.0, 1.7})  // through its middle and beside
    for (const double width_m : {0.01, 0.032, 0.2}) {
      const Hazard groove =
          MakeOf("groove", "{depth_m: 0.005, width_m: " + std::to_string(width_m) + "}",
                 {{at_m, -0.5}, {at_m, 0.5}});
      const Hazard dut = Laid({Cover(), groove})[0];
      EXPECT_NEAR(Volume(dut), kSection_m2 * (2 - width_m), 1e-9) << at_m << " " << width_m;
      EXPECT_EQ(dut.solids.size(), 2u);
      EXPECT_EQ(TopAt(dut, {at_m, 0}), 0);
    }
}

TEST(LayFloors, WhatDoesNotReachACoverLeavesItWhole) {
  const Hazard beside = MakeOf("groove", "{width_m: 0.1}", {{1, 0.2}, {1, 0.6}});
  const Hazard touching = MakeOf("step", "{height_m: -0.1}", Rectangle({0, 0.045}, {2, 1}));
  for (const Hazard& later : {beside, touching}) {
    const Hazard dut = Laid({Cover(), later}, "cable_cover");
    ASSERT_EQ(dut.solids.size(), 1u);
    EXPECT_EQ(dut.solids[0].base, Cover().solids[0].base);
  }
}

// A groove over one half of it, along its line: the other half keeps its flank and half its top.
TEST(LayFloors, AGrooveAlongACoverTakesOneFlank) {
  for (const double edge_m : {-0.04, -0.03, 0.0, 0.03, 0.04}) {
    const Hazard groove =
        MakeOf("groove", "{width_m: 1, depth_m: 0.1}", {{-1, edge_m + 0.5}, {3, edge_m + 0.5}});
    const Hazard dut = Laid({Cover(), groove})[0];
    for (double across = -0.05; across < 0.05; across += 0.0021)
      EXPECT_NEAR(TopAt(dut, {1, across}), across < edge_m ? CoverHeight(across) : 0, 2e-5)
          << edge_m << " " << across;
  }
}

// In a pit that cuts it askew it lies below the floor, beside it on that, whichever is written
// first.
TEST(LayFloors, ACoverAcrossAPitKeepsItsHeightBesideIt) {
  Stream draws(1, 0, "askew");
  for (int i = 0; i < 60; ++i) {
    const double yaw_rad = draws.Uniform(-kPi, kPi), middle_m = draws.Uniform(0, 2);
    const double across_m = draws.Uniform(-0.06, 0.06), corner_m = draws.Uniform(0.01, 0.3);
    const Pose2 X{middle_m, across_m, yaw_rad};
    const int corners = 3 + static_cast<int>(draws.Below(4));
    Polygon hole = RegularPolygon(Vec2::Zero(), corner_m, corners);
    for (Vec2& p : hole) p = X * p;
    const Hazard pit = MakeOf("step", "{height_m: -0.1}", hole);
    const Hazard dut =
        i % 2 ? Laid({Cover(), pit}, "cable_cover") : Laid({pit, Cover()}, "cable_cover");
    for (int k = 0; k < 300; ++k) {
      const Vec2 p(draws.Uniform(0.001, 1.999), draws.Uniform(-0.05, 0.05));
      const double edge_m = SignedDistance(hole, p);
      if (std::abs(edge_m) < 5e-4) continue;  // thin pieces are left out
      EXPECT_NEAR(TopAt(dut, p), edge_m > 0 ? CoverHeight(p.y()) : 0, 1e-4)
          << i << ": " << p.transpose() << ", " << edge_m << " from the hole";
    }
    const Pose2 turn{0.3, -0.2, 1.1};
    Polygon turned_hole = hole;
    for (Vec2& p : turned_hole) p = turn * p;
    const Hazard turned =
        Laid({MakeOf("cable_cover", "{width_m: 0.09, top_width_m: 0.05, height_m: 0.02}",
                     {turn * Vec2(0, 0), turn * Vec2(2, 0)}),
              MakeOf("step", "{height_m: -0.1}", turned_hole)},
             "cable_cover");
    for (int k = 0; k < 50; ++k) {
      const Vec2 p(draws.Uniform(0.001, 1.999), draws.Uniform(-0.05, 0.05));
      if (std::abs(SignedDistance(hole, p)) < 5e-4) continue;
      EXPECT_NEAR(TopAt(turned, turn * p), TopAt(dut, p), 1e-4) << i << ": " << p.transpose();
    }
  }
}

TEST(LayFloors, BumpsAreCutToo) {
  const Hazard rough =
      MakeOf("rough", "{amplitude_m: 0.01, wavelength_m: 0.1}", Rectangle({0, 0}, {1, 1}));
  const char* wide = "{width_m: 1.5, depth_m: 0.1}";
  const Hazard half = MakeOf("groove", wide, {{1.25, -1}, {1.25, 2}});
  const Hazard through = MakeOf("groove", wide, {{1.3, -1}, {1.3, 2}});
  const double left = Volume(Laid({rough, half})[0]);
  const double more = Volume(Laid({rough, through})[0]);
  double column = 0;  // of the bumps that the second cuts through their middles
  for (const Solid& s : rough.solids)
    if (s.base[0].x() > 0.5 && s.base[0].x() < 0.55) {
      Hazard one = rough;
      one.solids = {s};
      column += Volume(one);
    }
  EXPECT_GT(column, 0);
  EXPECT_NEAR(more - left, column / 2, 1e-3 * column) << "half of each";
}

// On the platform from x = 1: each part of the cover lies on its own floor.
TEST(LayFloors, ACoverAcrossAnEdgeLiesOnBothFloors) {
  for (const double height_m : {0.05, -0.05}) {
    std::vector<Hazard> hazards = {
        MakeOf("step", "{height_m: " + std::to_string(height_m) + "}", Rectangle({1, -1}, {3, 1})),
        Cover()};
    std::vector<std::string> warnings;
    hazards[1].id = "c";
    LayFloors(hazards, warnings);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(warnings[0].substr(0, 20), "c lies across the ed");
    EXPECT_NEAR(Volume(hazards[1]), 2 * kSection_m2, 1e-9);
    for (const Solid& s : hazards[1].solids)
      EXPECT_NEAR(s.z_low_m, s.base[0].x() + s.base[1].x() > 2 ? height_m : 0, 1e-12);
  }
}

// In a pit, on a platform within it, and on plain floor: the cover's own height everywhere.
TEST(LayFloors, ACoverAcrossSeveralEdgesKeepsItsHeight) {
  Stream draws(2, 0, "edges");
  for (int i = 0; i < 30; ++i) {
    std::vector<Hazard> hazards;
    for (const double height_m : {-0.1, 0.05, 0.02}) {
      const Pose2 X{draws.Uniform(0.3, 1.7), draws.Uniform(-0.1, 0.1), draws.Uniform(-kPi, kPi)};
      Polygon outline = RegularPolygon(Vec2::Zero(), draws.Uniform(0.1, 0.6),
                                       3 + static_cast<int>(draws.Below(4)));
      for (Vec2& p : outline) p = X * p;
      hazards.push_back(MakeOf("step", "{height_m: " + std::to_string(height_m) + "}", outline));
    }
    const std::vector<Hazard> levels = hazards;
    hazards.insert(hazards.begin() + i % 4, Cover());  // wherever it is written
    const Hazard dut = Laid(hazards, "cable_cover");
    for (int k = 0; k < 200; ++k) {
      const Vec2 p(draws.Uniform(0.001, 1.999), draws.Uniform(-0.044, 0.044));
      double floor_m = 0, border_m = 1;
      for (std::size_t j = 0; j < levels.size(); ++j) {
        const double off_m = SignedDistance(levels[j].footprint[0], p);
        border_m = std::min(border_m, std::abs(off_m));
        if (off_m > 0) continue;
        floor_m = levels[j].height_m;
      }
      if (border_m < 5e-4) continue;
      double top_m = -1;
      for (const Solid& solid : dut.solids)
        if (Contains(solid.base, p)) top_m = std::max(top_m, solid.z_low_m + HeightOf(solid, p));
      EXPECT_NEAR(top_m, floor_m + CoverHeight(p.y()), 1e-4) << i << ": " << p.transpose();
    }
  }
}

// However small it is beside what it is cut from.
TEST(LayFloors, ASmallHoleInALargeFloorIsOpen) {
  const Hazard hall = MakeOf("step", "{height_m: 0.05}", Rectangle({0, 0}, {60, 60}));
  for (const double size_m : {0.001, 0.02, 0.05}) {
    const Polygon hole = Rectangle({30, 30}, {30 + size_m, 30 + size_m});
    const Hazard dut = Laid({hall, MakeOf("step", "{height_m: -0.05}", hole)})[0];
    EXPECT_EQ(TopAt(dut, {30 + size_m / 2, 30 + size_m / 2}), 0) << size_m;
    EXPECT_NEAR(TopAt(dut, {30 - 1e-3, 30}), 0.05, 1e-12) << size_m;
  }
}

// A circle of many corners leaves no slots beside it, where slices between two corners are thin.
TEST(LayFloors, ARoundHoleOfManyCornersLeavesTheRestWhole) {
  const Hazard floor = MakeOf("step", "{height_m: 0.05}", Rectangle({-1, -1}, {1, 1}));
  for (const int corners : {40, 400, 4000}) {
    const Polygon hole = RegularPolygon(Vec2::Zero(), 0.1, corners);
    const Hazard dut = Laid({floor, MakeOf("step", "{height_m: -0.05}", hole)})[0];
    EXPECT_NEAR(Volume(dut), 0.05 * (4 - SignedArea(hole)), 1e-4) << corners;
    double slots_m = 0;  // one above the hole, one below it
    for (double y = -0.11; y < 0.11; y += 5e-5) slots_m += TopAt(dut, {0.3, y}) == 0 ? 5e-5 : 0;
    EXPECT_LT(slots_m, 4e-4) << corners;
  }
}

TEST(LayFloors, CoversThatCrossStayBoth) {
  const Hazard other = MakeOf("cable_cover", "{}", {{1, -1}, {1, 1}});
  const auto dut = Laid({Cover(), other});
  EXPECT_NEAR(Volume(dut[0]), Volume(Cover()), 1e-12);
  EXPECT_NEAR(Volume(dut[1]), Volume(other), 1e-12);
}

// A cover does not bend over a ramp; water does.
TEST(LayFloors, WhatIsBuiltOnARampIsNamed) {
  Hazard ramp = MakeOf("ramp", "{slope_deg: 5}", Rectangle({-1, -1}, {3, 1}));
  ramp.id = "ramp";
  Hazard cover = Cover(), wet = MakeOf("wet", "{}", Rectangle({0, 0}, {1, 1})), far = Cover();
  cover.id = "cover";
  for (Solid& solid : far.solids)
    for (Polygon* polygon : {&solid.base, &solid.top})
      for (Vec2& p : *polygon) p.y() += 1.045;  // touches it
  const auto warned = [&](std::vector<Hazard> hazards) {
    std::vector<std::string> warnings;
    LayFloors(hazards, warnings);
    return warnings;
  };
  EXPECT_EQ(warned({ramp, cover}).size(), 1u);
  EXPECT_NE(warned({ramp, cover})[0].find("cover lies on the slope of ramp"), std::string::npos);
  EXPECT_TRUE(warned({ramp, wet}).empty());
  EXPECT_TRUE(warned({ramp, far}).empty());
}

// Its time grows with the cube of their number: 1,000 would take minutes.
TEST(LayFloors, ManyHazardsOnOnePlaceAreRefused) {
  const auto lay = [](int n) {
    std::vector<Hazard> hazards;
    for (int i = 0; i < n; ++i)
      hazards.push_back(
          MakeOf("step", "{height_m: 0.01}", Rectangle({0.001 * i, 0}, {1 + 0.001 * i, 1})));
    std::vector<std::string> warnings;
    LayFloors(hazards, warnings);
  };
  EXPECT_NO_THROW(lay(50));
  EXPECT_THROW(lay(400), InputError);
}

// The slopes round a carpet that is not convex are wedges: a groove takes its width of them, too.
TEST(LayFloors, AGrooveAcrossACarpetTakesItsWidthOfTheSlopesToo) {
  const Polygon corner = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  const double w = 0.02, h = 0.01, width_m = 0.03;
  const Hazard carpet = MakeOf("carpet", "{height_m: 0.01, bevel: 2}", corner);
  // Straight across the one arm, then aslant over the inner corner.
  const Hazard straight =
      MakeOf("groove", "{width_m: 0.03, depth_m: 0.02}", {{1.5, -0.5}, {1.5, 1.5}});
  const double taken = width_m * h * (1 - w);  // the arm is 1 m wide, its slopes count half
  EXPECT_NEAR(Volume(Laid({carpet, straight})[0]), Volume(carpet) - taken, 2e-7);
  const Hazard aslant =
      MakeOf("groove", "{width_m: 0.03, depth_m: 0.02}", {{0.5, 0.5}, {1.5, 1.5}});
  const double left = Volume(Laid({carpet, aslant})[0]);
  EXPECT_LT(left, Volume(carpet) - 0.03 * h * 0.6);
  EXPECT_GT(left, Volume(carpet) - 0.03 * h * 0.8);
}

}  // namespace
}  // namespace floorproof
