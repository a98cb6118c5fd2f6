// SPDX-License-Identifier: Apache-2.0
// Levels that ramps lead to.
#include "env/core/ramps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "env/core/coverage.h"

namespace floorproof {
namespace {

constexpr double kStep_m = 0.01, kRise = 0.1;  // of the ramps, per metre

Polygon In(const Pose2& X, Polygon polygon) {
  for (Vec2& p : polygon) p = X * p;
  return polygon;
}

Hazard Level(const char* id, const Pose2& X, const Vec2& low, const Vec2& high, double height_m) {
  Hazard hazard;
  hazard.id = id;
  hazard.hazard_class = HazardClass::kLevelChange;
  hazard.height_m = height_m;
  hazard.footprint = {In(X, Rectangle(low, high))};
  hazard.solids = {{height_m < 0 ? Solid::Kind::kCut : Solid::Kind::kPrism,
                    hazard.footprint[0],
                    {},
                    std::min(height_m, 0.0),
                    std::max(height_m, 0.0)}};
  return hazard;
}

// Rises (or falls) along the frame's x from height 0 on.
Hazard Ramp(const char* id, const Pose2& X, const Vec2& low, const Vec2& high, double rise,
            double from_m = 0) {
  Hazard hazard;
  hazard.id = id;
  hazard.hazard_class = HazardClass::kTerrain;
  const double end_m = from_m + rise * (high - low).x();
  hazard.height_m = end_m;
  hazard.footprint = {In(X, Rectangle(low, high))};
  hazard.solids = {{Solid::Kind::kPrism,
                    hazard.footprint[0],
                    {},
                    std::min({from_m, end_m, 0.0}),
                    std::max(from_m, end_m),
                    X.Rotate({rise, 0})}};
  return hazard;
}

// 10 m x 6 m, open on all sides.
HazardMap Hall(const Pose2& X) {
  HazardMap map;
  map.frame = {20, 12, 0.5, X};
  map.occupancy = Grid<CellState>(20, 12);
  return map;
}

const Hazard* Find(const HazardMap& map, const std::string& id) {
  const auto at = std::ranges::find(map.hazards, id, &Hazard::id);
  return at != map.hazards.end() ? &*at : nullptr;
}

double LengthOf(const Hazard& edge) {  // strips are 1 cm wide
  double area = 0;
  for (const Polygon& strip : edge.footprint) area += SignedArea(strip);
  return area / 0.01;
}

double SweptFrom(const HazardMap& map, const Pose2& X, const Vec2& p) {
  Shape2 disc;
  disc.radius_m = 0.2;
  return ComputeSweepArea(map, disc, disc, kStep_m, X * p).area_m2();
}

const Pose2 kFrames[] = {{}, {3, -2, kPi / 180}, {-1, 4, 0.7}};

TEST(OpenByRamps, WithoutARampTheMapIsAsItIs) {
  HazardMap map = Hall({});
  map.hazards = {Level("platform", {}, {5, 2}, {8, 4}, 0.2)};
  const HazardMap dut = OpenByRamps(map, kStep_m);
  ASSERT_EQ(dut.hazards.size(), 1u);
  EXPECT_EQ(dut.hazards[0].footprint, map.hazards[0].footprint);
}

TEST(OpenByRamps, APlatformIsFloorAndItsEdgeIsNot) {
  for (const Pose2& X : kFrames) {
    HazardMap map = Hall(X);
    map.hazards = {Level("platform", X, {5, 2}, {8, 4}, 0.2),
                   Ramp("ramp", X, {3, 2.5}, {5, 3.5}, kRise)};
    const HazardMap dut = OpenByRamps(map, kStep_m);
    EXPECT_EQ(Find(dut, "platform"), nullptr);
    const Hazard* edge = Find(dut, "platform edge");
    ASSERT_NE(edge, nullptr);
    EXPECT_TRUE(IsObstacle(*edge, kStep_m));
    EXPECT_NEAR(edge->height_m, 0.2, 1e-9);
    EXPECT_NEAR(LengthOf(*edge), 10 - 1, 0.05);  // but where the ramp ends
    const Hazard* sides = Find(dut, "ramp edge");
    ASSERT_NE(sides, nullptr);
    EXPECT_NEAR(LengthOf(*sides), 2 * (2 - kStep_m / kRise), 0.05);  // from where it is a step
    // Around the platform, over the ramp, and on the platform.
    const double floor_m2 = SweptFrom(map, X, {1, 3});
    // 6 m^2 of platform, but for what is lost along 12.8 m of edges: two cells of 5 cm, and
    // corners.
    EXPECT_NEAR(SweptFrom(dut, X, {1, 3}), floor_m2 + 6 - 12.8 * 0.1, 0.3);
    EXPECT_NEAR(SweptFrom(dut, X, {6, 3}), SweptFrom(dut, X, {1, 3}), 1e-9) << "both ways";
  }
}

TEST(OpenByRamps, ARampThatEndsTooHighOpensNothing) {
  HazardMap map = Hall({});
  map.hazards = {Level("platform", {}, {5, 2}, {8, 4}, 0.2 - 1.5 * kStep_m),
                 Ramp("ramp", {}, {3, 2.5}, {5, 3.5}, kRise)};
  EXPECT_NE(Find(OpenByRamps(map, kStep_m), "platform"), nullptr);
  map.hazards[0] = Level("platform", {}, {5, 2}, {8, 4}, 0.2 - 0.9 * kStep_m);
  EXPECT_EQ(Find(OpenByRamps(map, kStep_m), "platform"), nullptr);
  map.hazards[0] = Level("platform", {}, {5.1, 2}, {8, 4}, 0.2);
  EXPECT_NE(Find(OpenByRamps(map, kStep_m), "platform"), nullptr) << "a gap of 10 cm between";
}

TEST(OpenByRamps, OneRampAfterTheOtherLeadsUpAndDown) {
  HazardMap map = Hall({});
  map.hazards = {
      Level("first", {}, {2, 2}, {4, 4}, 0.1),  Ramp("up", {}, {1, 2.5}, {2, 3.5}, kRise),
      Level("second", {}, {5, 2}, {7, 4}, 0.2), Ramp("on", {}, {4, 2.5}, {5, 3.5}, kRise, 0.1),
      Level("pit", {}, {9, 0}, {10, 6}, -0.1),  Ramp("down", {}, {8, 2.5}, {9, 3.5}, -kRise)};
  const HazardMap dut = OpenByRamps(map, kStep_m);
  for (const char* id : {"first", "second", "pit"}) EXPECT_EQ(Find(dut, id), nullptr) << id;
  EXPECT_NEAR(LengthOf(*Find(dut, "pit edge")), 14 - 1, 0.05);
}

}  // namespace
}  // namespace floorproof
