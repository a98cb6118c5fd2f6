// SPDX-License-Identifier: Apache-2.0
// Bumpers and cliff sensors: what presses a bumper and where, and that a drop is reported before
// the robot falls into it.
#include <cmath>

#include "tests/robots.h"
#include "tests/sensors/sensor_rig.h"

namespace floorproof {
namespace {

TEST(Bumper, IsPressedWhereTheRobotMeetsAWall) {
  for (const auto& [twist, bearing_rad] : {std::pair(BodyTwist{0.2, 0, 0}, 0.0),
                                           {BodyTwist{-0.2, 0, 0}, kPi},
                                           {BodyTwist{0, 0.2, 0}, kPi / 2}}) {
    SensorRig rig(Room(2, 2), "htetro", {2, 2, 0});
    rig.Carry(MakeSensor("bumper"));
    EXPECT_FALSE(rig.Sense().bump.pressed);
    bool pressed = false;
    for (int i = 0; i < 300 && !pressed; ++i) {
      const Bump& bump = rig.Drive(twist).bump;
      pressed = bump.pressed;
      if (pressed) {
        EXPECT_LT(std::abs(WrapAngle(bump.bearing_rad - bearing_rad)), kPi / 8);
      }
    }
    EXPECT_TRUE(pressed);
  }
}

TEST(Bumper, DrivingFreelyPressesNothing) {
  SensorRig rig(Room(6, 4), "beluga", {2, 3, 0});
  rig.Carry(MakeSensor("bumper"));
  for (int i = 0; i < 300; ++i) EXPECT_FALSE(rig.Drive({0.2, 0, 0.1}).bump.pressed);
}

HazardMap WithPit(double depth_m) {
  HazardMap map = Room(6, 4);
  Hazard pit = Block(HazardClass::kLevelChange, {4, 1}, {5, 5}, -depth_m);
  pit.solids[0] = {Solid::Kind::kCut, pit.footprint[0], {}, -depth_m, 0};
  map.hazards = {pit};
  return map;
}

TEST(Cliff, TellsADropBeforeTheWheelsAreOverIt) {
  for (const std::string& robot : RobotNames()) {
    SensorRig rig(WithPit(0.1), robot, {3, 3, 0});
    rig.Carry(MakeSensor("cliff"));
    EXPECT_FALSE(rig.Sense().cliffs.any()) << robot;
    bool told = false;
    for (int i = 0; i < 500 && !told; ++i) {
      const CliffRing& cliffs = rig.Drive({0.1, 0, 0}).cliffs;
      told = cliffs.any();
      if (told) {
        EXPECT_TRUE(cliffs.drop[0] || cliffs.drop[1] || cliffs.drop[7]) << "ahead";
        EXPECT_FALSE(cliffs.drop[3] || cliffs.drop[4] || cliffs.drop[5]) << "behind";
      }
    }
    EXPECT_TRUE(told) << robot;
    EXPECT_NEAR(rig.truth().p_WB.z(), 0, 0.003) << robot << " stands on the floor";
  }
}

TEST(Cliff, AShallowStepIsNoDrop) {
  SensorRig rig(WithPit(0.01), "beluga", {3.7, 3, 0});
  rig.Carry(MakeSensor("cliff"));
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(rig.Drive({0.1, 0, 0}).cliffs.any());
}

TEST(Cliff, SeesDropsOnAllSides) {
  HazardMap map = Room(6, 6);
  for (const auto& [low, high] :
       {std::pair(Vec2(4.4, 1), Vec2(5, 7)), {Vec2(3, 1), Vec2(3.6, 7)}}) {
    Hazard pit = Block(HazardClass::kLevelChange, low, high, -0.1);
    pit.solids[0] = {Solid::Kind::kCut, pit.footprint[0], {}, -0.1, 0};
    map.hazards.push_back(pit);
  }
  SensorRig rig(map, "beluga", {4, 4, kPi / 2});  // the pits begin 0.4 m to its left and right
  rig.Carry(MakeSensor("cliff"));
  EXPECT_FALSE(rig.Sense().cliffs.any());
  rig.Put({4.35, 4, kPi / 2});
  rig.Carry(MakeSensor("cliff"));
  const CliffRing& right = rig.Sense().cliffs;
  EXPECT_TRUE(right.drop[6]) << "to its right";
  EXPECT_FALSE(right.drop[2]);
  EXPECT_FALSE(right.drop[0]);
}

}  // namespace
}  // namespace floorproof
