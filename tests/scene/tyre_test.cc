// SPDX-License-Identifier: Apache-2.0
#include "env/scene/tyre.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "env/scene/scene.h"

namespace floorproof {
namespace {

// Gent's own table: 3.6 MPa at 60 Shore A, 9.4 MPa at 80.
TEST(Tyre, RubberIsAsStiffAsItsHardnessSays) {
  EXPECT_NEAR(RubberModulus(60) / 1e6, 3.6, 0.05);
  EXPECT_NEAR(RubberModulus(80) / 1e6, 9.4, 0.1);
  EXPECT_LT(ShoreHardness(TyreMaterial::kSoftRubber), ShoreHardness(TyreMaterial::kHardRubber));
  EXPECT_LT(ShoreHardness(TyreMaterial::kHardRubber), ShoreHardness(TyreMaterial::kPolyurethane));
}

// A foundation's pressure E (s - x^2 / 2R) / t, summed over the patch.
TEST(Tyre, SinksByThePressureOfItsPatch) {
  const Tread tread{.radius_m = 0.1, .width_m = 0.04};
  const double sink_m = SinkOf(tread, TyreMaterial::kSoftRubber, 100);
  const double half_m = std::sqrt(2 * tread.radius_m * sink_m);
  double load_n = 0;
  constexpr int kStrips = 10'000;
  for (int i = 0; i < kStrips; ++i) {
    const double x_m = half_m * (2 * (i + 0.5) / kStrips - 1);
    load_n += RubberModulus(60) * (sink_m - x_m * x_m / (2 * tread.radius_m)) / 0.01 *
              tread.width_m * 2 * half_m / kStrips;
  }
  EXPECT_NEAR(load_n, 100, 0.01);
}

TEST(Tyre, IsStifferUnderMoreLoadUnlessTheRobotStatesIt) {
  const Tread wheel{.radius_m = 0.1, .width_m = 0.04}, ball{.radius_m = 0.02};
  for (const Tread& tread : {wheel, ball}) {
    const Tyre light = TyreUnder(20, tread, {}, 10), heavy = TyreUnder(160, tread, {}, 10);
    EXPECT_NEAR(heavy.stiffness_npm / light.stiffness_npm, 2, 1e-9);  // the third root of 8
    const Tyre stated = TyreUnder(20, tread, {.stiffness_npm = 3e5, .damping_ratio = 0.5}, 10);
    EXPECT_EQ(stated.stiffness_npm, 3e5);
    EXPECT_NEAR(stated.damping_nspm, 2 * 0.5 * std::sqrt(3e5 * 5), 1e-9);
  }
}

HazardMap Floor() {
  HazardMap map;
  map.frame = {8, 8, 0.5, {}};
  map.occupancy = Grid<CellState>(8, 8);
  map.floor_friction = 0.6;
  return map;
}

TEST(WheelPairs, HaveTheFrictionOfWhatIsMetAndTheTyresStiffness) {
  HazardMap map = Floor();
  Hazard ice;
  ice.id = "ice";
  const Polygon plate = {{2, 2}, {3, 2}, {3, 3}, {2, 3}};
  ice.solids = {{Solid::Kind::kPrism, plate, {}, 0, 0.01}};
  ice.material.friction = 0.1;
  Hazard pane = ice;
  pane.id = "pane";
  pane.solids[0].base = {{3.2, 2}, {3.3, 2}, {3.3, 3}, {3.2, 3}};
  pane.material.friction = {};
  pane.material.restitution = 0.7;
  map.hazards = {ice, pane};
  const RobotModel robot = ReadRobot(FindRobotFile("rover", {}));
  const Scene scene = BuildScene(map, robot, {}, {1, 1, 0});
  const mjModel* m = scene.model.get();
  ASSERT_EQ(m->npair, 4 * 3);
  for (int p = 0; p < m->npair; ++p) {
    const bool first = m->geom_bodyid[m->pair_geom1[p]] == 0;
    const int other = first ? m->pair_geom1[p] : m->pair_geom2[p];
    const int wheel = first ? m->pair_geom2[p] : m->pair_geom1[p];
    const int hazard = scene.roles[static_cast<std::size_t>(other)].hazard;
    EXPECT_EQ(m->pair_friction[5 * p], hazard == 0 ? 0.1 : 0.6);
    EXPECT_EQ(m->pair_friction[5 * p + 1], m->pair_friction[5 * p]);
    const mjtNum* solref = m->pair_solref + mjNREF * p;
    if (hazard == 1) {  // what bounces keeps its own softness
      const mjtNum* own = m->geom_solref + mjNREF * other;
      EXPECT_EQ(solref[0], own[0]);
      EXPECT_EQ(solref[1], own[1]);
      EXPECT_LT(own[1], 1);
      continue;
    }
    const auto foot = std::ranges::find(robot.feet, mj_id2name(m, mjOBJ_GEOM, wheel), &Foot::geom);
    ASSERT_NE(foot, robot.feet.end());
    const double d = m->pair_solimp[mjNIMP * p];
    const double inverse_mass = m->body_invweight0[2 * m->geom_bodyid[wheel]];
    EXPECT_NEAR(-solref[0] / ((1 - d) * inverse_mass), foot->tyre.stiffness_npm,
                1e-6 * foot->tyre.stiffness_npm);
    EXPECT_NEAR(m->pair_margin[p], foot->sink_m(), 1e-12);
  }
}

// The loads of the feet carry the robot, and sink it nowhere.
TEST(Feet, CarryEachRobot) {
  for (const RobotEntry& entry : Robots()) {
    const RobotModel robot = ReadRobot(FindRobotFile(std::string(entry.name), {}));
    double load_n = 0;
    for (const Foot& foot : robot.feet) load_n += foot.load_n;
    EXPECT_NEAR(load_n, robot.spec.mass_kg * 9.81, 0.01 * load_n) << entry.name;
    const auto driven = std::ranges::count_if(robot.feet, &Foot::driven);
    EXPECT_EQ(static_cast<std::size_t>(driven), robot.spec.wheels.size()) << entry.name;
  }
}

}  // namespace
}  // namespace floorproof
