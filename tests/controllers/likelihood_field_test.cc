// SPDX-License-Identifier: Apache-2.0
#include "controllers/likelihood_field.h"

#include <gtest/gtest.h>

namespace floorproof {
namespace {

// A level scan meets a ramp where it is as high as the scan, not at its foot.
TEST(LikelihoodField, ARampIsMetFromTheHeightOfTheScanOn) {
  for (const Pose2& X : {Pose2{}, Pose2{3, -2, 0.7}}) {
    HazardMap map;
    map.frame = {160, 80, 0.05, X};
    map.occupancy = Grid<CellState>(160, 80);
    Polygon place = Rectangle({2, 1}, {6, 3});
    for (Vec2& p : place) p = X * p;
    Hazard ramp;
    ramp.hazard_class = HazardClass::kTerrain;
    ramp.footprint = {place};
    ramp.solids = {{Solid::Kind::kPrism, place, {}, 0, 0.4, X.Rotate({0.1, 0})}};
    map.hazards = {ramp};
    const LikelihoodField dut(map, 0.3);
    const auto away_m = [&](double x, double y) {
      return dut.StepsAway(X * Vec2(x, y)) * LikelihoodField::kStep_m;
    };
    EXPECT_NEAR(away_m(4.5, 2), 0.5, 0.05) << "0.3 m high at x = 5 m";
    EXPECT_NEAR(away_m(5.5, 2), 0, 1e-9);
    EXPECT_EQ(dut.StepsAway(X * Vec2(2.0, 2)), 255) << "its foot, 3 m away";
  }
}

}  // namespace
}  // namespace floorproof
