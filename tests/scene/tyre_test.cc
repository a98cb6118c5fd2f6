// SPDX-License-Identifier: Apache-2.0
#include "env/scene/tyre.h"

#include <gtest/gtest.h>

#include <string>

#include "env/scene/scene.h"

namespace floorproof {
namespace {

HazardMap Floor() {
  HazardMap map;
  map.frame = {8, 8, 0.5, {}};
  map.occupancy = Grid<CellState>(8, 8);
  map.floor_friction = 0.6;
  return map;
}

std::size_t TyresOf(const std::string& name) {
  const RobotModel robot = ReadRobot(FindRobotFile(name, {}));
  return ScrubbingTyres(robot.mjcf.get(), robot.spec).size();
}

// Two wheels on one axle turn about it without a slide, and rollers do not slide.
TEST(Tyre, IsThatOfPlainWheelsOnSeveralAxles) {
  EXPECT_EQ(TyresOf("rover"), 4u);
  EXPECT_EQ(TyresOf("beluga"), 0u);
  EXPECT_EQ(TyresOf("htetro"), 0u);
}

TEST(Tyre, HasTheFrictionOfWhatItMeets) {
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
  const Scene scene = BuildScene(map, ReadRobot(FindRobotFile("rover", {})), {}, {1, 1, 0});
  const mjModel* m = scene.model.get();
  ASSERT_EQ(m->npair, 4 * 3);
  for (int p = 0; p < m->npair; ++p) {
    const int other = m->geom_bodyid[m->pair_geom1[p]] == 0 ? m->pair_geom1[p] : m->pair_geom2[p];
    const int hazard = scene.roles[static_cast<std::size_t>(other)].hazard;
    EXPECT_EQ(m->pair_friction[5 * p], hazard == 0 ? 0.1 : 0.6);
    EXPECT_EQ(m->pair_friction[5 * p + 1], m->pair_friction[5 * p]);
    // Rubber is softer than the floor, but not than what bounces.
    const mjtNum* own = m->geom_solref + mjNREF * other;
    if (hazard == 1) {
      EXPECT_EQ(m->pair_solref[mjNREF * p], own[0]);
      EXPECT_EQ(m->pair_solref[mjNREF * p + 1], own[1]);
      EXPECT_LT(own[1], 1);
    } else {
      EXPECT_GT(m->pair_solref[mjNREF * p], own[0]);
    }
  }
}

}  // namespace
}  // namespace floorproof
