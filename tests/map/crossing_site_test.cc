// SPDX-License-Identifier: Apache-2.0
// Sites of one crossing: the hazard lies on the robot's way as asked, whatever its type.
#include "env/map/crossing_site.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "env/core/passages.h"
#include "env/geometry/box.h"
#include "env/geometry/convex.h"
#include "env/hazards/hazard_type.h"
#include "env/map/site.h"

namespace floorproof {
namespace {

using ::testing::HasSubstr;

constexpr double kNear_m = 1e-6;

ConfigNode SiteOf(const std::string& generate, const std::string& more = "") {
  return ParseYaml("site: 1\ngenerate: {kind: crossing, " + generate + "}\n" + more, "site.yaml");
}
HazardMap Lay(const std::string& generate, const std::string& more = "") {
  return ReadSite(GeneratedSite(SiteOf(generate, more), 0, 0), "/nowhere").map;
}

// A robot 0.6 m long and 0.4 m wide.
constexpr const char* kOutline = "outline_m: [[-0.3, -0.2], [0.3, -0.2], [0.3, 0.2], [-0.3, 0.2]]";

Polygon OutlineAt(const Pose2& X_WB) {
  Polygon outline = Rectangle({-0.3, -0.2}, {0.3, 0.2});
  for (Vec2& p : outline) p = X_WB * p;
  return outline;
}

double AreaOn(const HazardMap& map, const Polygon& outline) {
  double area = 0;
  for (const Hazard& hazard : map.hazards)
    area += Area(Intersection({{outline, {}}}, hazard.footprint));
  return area;
}

// How far from where it starts the robot first comes within reach of the hazard, and was last.
std::pair<double, double> WithinReachFromTo(const HazardMap& map) {
  const double way_m = (*map.goal - map.start->p()).norm();
  double first = -1, last = -1;
  for (double s = 0; s <= way_m; s += 0.001) {
    Pose2 at = *map.start;
    at.x_m += s;
    const auto is_near = [&](const Polygon& part) {
      return Separate(OutlineAt(at), part).distance_m <= kReach_m;
    };
    if (std::ranges::none_of(map.hazards[0].footprint, is_near)) continue;
    if (first < 0) first = s;
    last = s;
  }
  return {first, last};
}

Box2 FootprintBox(const HazardMap& map) {
  std::vector<Vec2> corners;
  for (const Hazard& hazard : map.hazards)
    for (const Polygon& part : hazard.footprint)
      corners.insert(corners.end(), part.begin(), part.end());
  return BoxAround(corners);
}

// Angles and leads of all signs, over any type.
TEST(CrossingSite, RunUpAndRunOutAreAsAsked) {
  for (const char* how : {"", "angle_deg: 50", "angle_deg: -35, lead_deg: 70, share: 0.4",
                          "angle_deg: 20, lead_deg: -130, share: 0.7, side: right"}) {
    SCOPED_TRACE(how);
    const HazardMap dut =
        Lay(std::string(how) + (*how ? ", " : "") + "run_up_m: 0.3, run_out_m: 0.4, " + kOutline);
    ASSERT_TRUE(dut.start && dut.goal);
    EXPECT_EQ(dut.start->y_m, dut.goal->y()) << "the way runs along +x";
    const auto [first, last] = WithinReachFromTo(dut);
    EXPECT_NEAR(first, 0.3, 0.002);
    EXPECT_NEAR((*dut.goal - dut.start->p()).norm() - last, 0.4, 0.002);
  }
}

// The edge that is met first, of a polygon its first one: its inward normal is turned by -angle.
TEST(CrossingSite, TheWayMeetsTheEdgeAtItsAngle) {
  for (const char* side : {"left", "right"})
    for (const double angle_deg : {-80.0, -30.0, 0.0, 10.0, 80.0}) {
      const HazardMap dut =
          Lay("hazard: lift_sill, sizes: {lift_sill: {level_m: 0.01}}, side: " + std::string(side) +
              ", angle_deg: " + FormatDouble(angle_deg));
      const Polygon& car = dut.hazards[0].footprint[0];
      const Vec2 edge = (car[1] - car[0]).normalized(), inward(-edge.y(), edge.x());
      EXPECT_NEAR(std::atan2(-inward.y(), inward.x()) * 180 / kPi, angle_deg, kNear_m) << side;
    }
}

TEST(CrossingSite, TheRobotComesAsItIsToLead) {
  EXPECT_NEAR(Lay("lead_deg: 90").start->yaw_rad, -kPi / 2, 1e-12) << "it drives to its left";
  EXPECT_EQ(Lay("").start->yaw_rad, 0);
}

// Across the way: from the robot's edge on the hazard's side to the hazard's end.
TEST(CrossingSite, AShareOfTheRobotsWidthPassesOverIt) {
  for (const double angle_deg : {-60.0, 0.0, 60.0})
    for (const double share : {0.1, 0.5, 0.9}) {
      const std::string how = "angle_deg: " + FormatDouble(angle_deg) +
                              ", share: " + FormatDouble(share) + ", " + kOutline;
      const HazardMap left = Lay(how), right = Lay(how + ", side: right");
      const double y_left = left.start->y_m + 0.2 - share * 0.4;
      EXPECT_NEAR(FootprintBox(left).low.y(), y_left, kNear_m) << how;
      EXPECT_GT(FootprintBox(left).high.y(), left.start->y_m + 0.2 + 0.5);
      const double y_right = right.start->y_m - 0.2 + share * 0.4;
      EXPECT_NEAR(FootprintBox(right).high.y(), y_right, kNear_m) << how;
    }
  // The whole width at any angle, and half a metre more on both sides.
  for (const double angle_deg : {-70.0, 0.0, 45.0}) {
    const HazardMap whole = Lay("angle_deg: " + FormatDouble(angle_deg) + ", " + kOutline);
    for (const double y_m : {whole.start->y_m - 0.7, whole.start->y_m + 0.7})
      EXPECT_GT(AreaOn(whole, Rectangle({-20, y_m - 0.01}, {20, y_m + 0.01})), 0.0099 * 0.5 * 2)
          << "0.5 m along the way, at angle " << angle_deg;
  }
}

TEST(CrossingSite, WhatIsPassedKeepsItsGap) {
  for (const std::string& type : PluginNames(HazardTypes()))
    for (const char* more :
         {"angle_deg: 0", "angle_deg: 75, side: right", "angle_deg: -40, lead_deg: 30"}) {
      const HazardMap dut =
          Lay("passage: beside, gap_m: 0.07, hazard: " + type + ", " + more + ", " + kOutline);
      double least = std::numeric_limits<double>::infinity();
      const Vec2 way = *dut.goal - dut.start->p();
      const Polygon outline = OutlineAt(*dut.start);
      for (const Hazard& hazard : dut.hazards)
        for (const Polygon& part : hazard.footprint) {
          // Of the swath that the outline sweeps: its corners, drawn out along the way.
          std::vector<Vec2> swept = outline;
          for (const Vec2& p : outline) swept.push_back(p + way);
          const Polygon swath = ConvexHull(swept);
          for (const Vec2& p : part) least = std::min(least, SignedDistance(swath, p));
          for (const Vec2& p : swath) least = std::min(least, SignedDistance(part, p));
        }
      EXPECT_NEAR(least, 0.07, 1e-3) << type << " " << more;
    }
}

TEST(CrossingSite, TheOtherSideIsItsMirrorImage) {
  const std::string how = "share: 0.6, wall_m: 0.2, sizes: {step: {height_m: -0.01}}, ";
  const HazardMap left = Lay(how + "angle_deg: 25, lead_deg: 40, side: left, " + kOutline);
  const HazardMap right = Lay(how + "angle_deg: -25, lead_deg: -40, side: right, " + kOutline);
  ASSERT_EQ(left.frame.height, right.frame.height);
  const double height_m = left.frame.height * left.frame.cell_m;
  EXPECT_NEAR(left.start->y_m, height_m - right.start->y_m, kNear_m);
  EXPECT_NEAR(left.start->x_m, right.start->x_m, kNear_m);
  EXPECT_NEAR(left.goal->x(), right.goal->x(), kNear_m);
  const Box2 a = FootprintBox(left), b = FootprintBox(right);
  EXPECT_NEAR(a.low.y(), height_m - b.high.y(), kNear_m);
  EXPECT_NEAR(a.low.x(), b.low.x(), kNear_m);
}

TEST(CrossingSite, WallsAreAsNearAsAsked) {
  for (const char* side : {"left", "right"}) {
    const HazardMap dut =
        Lay("wall_m: 0.15, share: 0.5, side: " + std::string(side) + ", " + kOutline);
    double nearest = std::numeric_limits<double>::infinity();
    for (int iy : {0, dut.frame.height - 1}) {
      EXPECT_TRUE(dut.IsWall(3, iy));
      const double face = iy == 0 ? dut.frame.cell_m : iy * dut.frame.cell_m;
      nearest = std::min(nearest, std::abs(dut.start->y_m - face) - 0.2);
    }
    EXPECT_NEAR(nearest, 0.15, kNear_m);
    EXPECT_EQ(dut.inset_m, 0);
  }
  // Else none is within a metre of what the robot sweeps.
  const HazardMap far = Lay(kOutline);
  EXPECT_GT(far.start->y_m - 0.2 - far.frame.cell_m, 1);
  EXPECT_GT(far.start->x_m - 0.3 - far.frame.cell_m, 1);
}

// The robot comes back down to the floor as it left it.
TEST(CrossingSite, ARampIsLedDownAgain) {
  const HazardMap dut =
      Lay("hazard: ramp, angle_deg: 30, length_m: 2, sizes: {ramp: {slope_deg: 5}}");
  ASSERT_EQ(dut.hazards.size(), 2u);
  const double depth_m = 2 * std::cos(30 * kPi / 180) / 2,
               top_m = depth_m * std::tan(5 * kPi / 180);
  const Vec2 n(std::cos(-30 * kPi / 180), std::sin(-30 * kPi / 180));  // the inward normal
  for (const Hazard& ramp : dut.hazards) EXPECT_NEAR(ramp.height_m, top_m, kNear_m);
  const Vec2 edge = dut.hazards[0].footprint[0][0];
  EXPECT_NEAR(TopAt(dut.hazards[0].solids[0], edge), 0, kNear_m);
  EXPECT_NEAR(TopAt(dut.hazards[0].solids[0], edge + depth_m * n), top_m, kNear_m);
  EXPECT_NEAR(TopAt(dut.hazards[1].solids[0], edge + depth_m * n), top_m, kNear_m);
  EXPECT_NEAR(TopAt(dut.hazards[1].solids[0], edge + 2 * depth_m * n), 0, kNear_m);
}

// It is laid out: nothing is drawn. Resolved, as it is written and as it is laid, it is the same.
TEST(CrossingSite, EveryTypeIsReadAgainAsItWas) {
  for (const std::string& type : PluginNames(HazardTypes())) {
    SCOPED_TRACE(type);
    const ConfigNode site = SiteOf("hazard: " + type + ", angle_deg: 33, share: 0.5, " + kOutline);
    const ConfigNode laid = GeneratedSite(site, 1, 2);
    EXPECT_EQ(WriteYaml(laid), WriteYaml(GeneratedSite(site, 3, 4)));
    const std::string resolved = WriteYaml(ResolveSite(laid, ".", "."));
    EXPECT_EQ(WriteYaml(ResolveSite(ParseYaml(resolved, "site.yaml"), ".", ".")), resolved);
    const ConfigNode whole = ResolveSite(site, ".", ".");
    EXPECT_EQ(WriteYaml(ResolveSite(whole, ".", ".")), WriteYaml(whole));
    EXPECT_EQ(WriteYaml(ResolveSite(GeneratedSite(whole, 0, 0), ".", ".")), resolved);
    EXPECT_NO_THROW(ReadSite(site, "/nowhere")) << "no seed is needed";
  }
}

TEST(CrossingSite, SizesAreThoseOfTheType) {
  const std::string sizes =
      "sizes: {step: {height_m: 0.004}, wet: {friction: 0.2}, groove: {width_m: 0.05}}, ";
  EXPECT_EQ(Lay(sizes + "hazard: step").hazards[0].height_m, 0.004);
  EXPECT_EQ(Lay(sizes + "hazard: wet").hazards[0].material.friction, 0.2);
  const HazardMap groove = Lay(sizes + "hazard: groove, length_m: 3");
  EXPECT_NEAR(FootprintBox(groove).Size().x(), 0.05, kNear_m) << "its own width, not length_m";
}

TEST(CrossingSite, HazardsOfTheSiteAreThereToo) {
  const HazardMap dut = Lay("", "hazards:\n  - {type: wet, polygon_m: [[1, 1], [2, 1], [2, 2]]}\n");
  ASSERT_EQ(dut.hazards.size(), 2u);
  EXPECT_EQ(dut.hazards[0].type, "wet") << "those that are written keep their index";
}

TEST(CrossingSite, BadInputNamesLineKeyAndRule) {
  const std::tuple<const char*, const char*, const char*> cases[] = {
      {"hazard: stairs", "generate.hazard = stairs", "must be one of"},
      {"angle_deg: 91", "generate.angle_deg = 91", "[-90, 90]"},
      {"share: 0", "generate.share = 0", "[0.01, 2]"},
      {"gap_m: -1", "generate.gap_m = -1", "[0, 5]"},
      {"passage: under", "generate.passage = under", "over"},
      {"sizes: {step: {hight_m: 1}}", "generate.sizes.step.hight_m", "did you mean height_m?"},
      {"sizes: {stap: {}}", "generate.sizes.stap", "did you mean step?"},
      {"sizes: {wet: {friction: 9}}", "generate.sizes.wet.friction = 9", "(0, 5]"},
      {"sizes: {step: {height_m: 0}}", "generate.sizes.step.height_m", "0.0001"},
      {"hazard: lift_sill, length_m: 0.02", "generate.sizes.lift_sill.polygon_m", "gap_m"},
      {"outline_m: [[0, 0], [1, 1]]", "generate.outline_m", "points"},
      {"cells: 12", "generate.cells", "unknown key"},
      {"seed: 1", "generate.seed", "unknown key"},
  };
  for (const auto& [yaml, where, rule] : cases) try {
      Lay(yaml);
      ADD_FAILURE() << yaml << " is taken";
    } catch (const InputError& e) {
      EXPECT_THAT(e.what(), HasSubstr(where)) << yaml;
      EXPECT_THAT(e.what(), HasSubstr(rule)) << yaml;
      EXPECT_THAT(e.what(), HasSubstr("site.yaml:")) << yaml;
    }
}

}  // namespace
}  // namespace floorproof
