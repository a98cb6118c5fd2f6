// SPDX-License-Identifier: Apache-2.0
// What measured limits say of a hazard, a floor and a step.
#include "env/core/measured_limits.h"

#include <gtest/gtest.h>

#include <cmath>

#include "env/core/hazard_map.h"
#include "env/core/ramps.h"
#include "env/core/robot_spec.h"

namespace floorproof {
namespace {

MeasuredLimits Measured(std::vector<MeasuredLimit> limits) {
  MeasuredLimits measured;
  measured.by = "a test";
  measured.frictions = {0.4, 0.8};
  measured.limits = std::move(limits);
  return measured;
}

Hazard OfSizes(std::vector<std::vector<HazardSize>> sizes) {
  Hazard hazard;
  hazard.hazard_class = HazardClass::kTerrain;
  hazard.sizes = std::move(sizes);
  return hazard;
}

TEST(MeasuredLimits, AreOfTheNearestFrictionsTheLesser) {
  const MeasuredLimits dut = Measured({{"step", {0.01, 0.02}}, {"drop", {0.03, 0.025}}});
  EXPECT_EQ(LimitOn(dut, "step", 0.4), 0.01);
  EXPECT_EQ(LimitOn(dut, "step", 0.8), 0.02);
  EXPECT_EQ(LimitOn(dut, "step", 0.6), 0.01);
  EXPECT_EQ(LimitOn(dut, "drop", 0.6), 0.025) << "more grip need not cross more";
  EXPECT_EQ(LimitOn(dut, "step", 0.2), 0.01);
  EXPECT_EQ(LimitOn(dut, "step", 1.0), 0.02);
  EXPECT_EQ(LimitOn(dut, "rough", 0.8), std::nullopt);
}

TEST(MeasuredLimits, CrossWhatIsWithinAllOfOneList) {
  const MeasuredLimits dut = Measured({{"step", {0.01, 0.01}}, {"drop", {0.03, 0.03}}});
  EXPECT_EQ(Crosses(dut, OfSizes(LevelSizes(0.010)), 0.8), true);
  EXPECT_EQ(Crosses(dut, OfSizes(LevelSizes(-0.010)), 0.8), true);
  EXPECT_EQ(Crosses(dut, OfSizes(LevelSizes(-0.02)), 0.8), false) << "it must come up again";
  EXPECT_EQ(Crosses(dut, OfSizes({{{"rough", 0.001}}}), 0.8), std::nullopt);
  EXPECT_EQ(Crosses(dut, OfSizes({{{"step", 0.001}, {"rough", 0.001}}}), 0.8), std::nullopt);
  EXPECT_EQ(Crosses(dut, OfSizes({{{"step", 0.02}}, {{"drop", 0.02}}}), 0.8), true);
  EXPECT_EQ(Crosses(dut, OfSizes({}), 0.8), std::nullopt);
}

TEST(MeasuredLimits, WhereNothingWasCrossedTheLeastIsAnObstacle) {
  const MeasuredLimits dut = Measured({{"step", {0, 0}}});
  EXPECT_EQ(Crosses(dut, OfSizes({{{"step", 1e-4}}}), 0.8), false);
}

// A hazard with less friction than the floor is as hard as on such a floor; a slippery patch is of
// the floor's, and as large as what it takes.
TEST(MeasuredLimits, FrictionOfItsOwnCounts) {
  const MeasuredLimits dut = Measured({{"step", {0.01, 0.02}}, {"wet", {0.5, 0.9}}});
  Hazard hazard = OfSizes({{{"step", 0.015}}});
  EXPECT_EQ(Crosses(dut, hazard, 0.8), true);
  hazard.material.friction = 0.4;
  EXPECT_EQ(Crosses(dut, hazard, 0.8), false);
  hazard.material.friction = 1.2;
  EXPECT_EQ(Crosses(dut, hazard, 0.4), false);
  Hazard patch = OfSizes({});
  patch.solids = {{Solid::Kind::kSurface, Rectangle({0, 0}, {1, 1}), {}, 0, 0}};
  EXPECT_EQ(Crosses(dut, patch, 0.8), std::nullopt) << "the floor's friction is none of its own";
  patch.material.friction = 0.2;
  EXPECT_EQ(Crosses(dut, patch, 0.8), true);
  EXPECT_EQ(Crosses(dut, patch, 0.4), false);
}

TEST(MeasuredLimits, AStepIsTrustedUpAndDown) {
  RobotSpec robot;
  robot.step_m = 0.013;
  EXPECT_EQ(TrustedStep(robot, 0.8), 0.013);
  robot.measured = Measured({{"step", {0.01, 0.02}}});
  EXPECT_EQ(TrustedStep(robot, 0.8), 0.02);
  robot.measured.limits.push_back({"drop", {0.03, 0.015}});
  EXPECT_EQ(TrustedStep(robot, 0.8), 0.015);
  EXPECT_EQ(TrustedStep(robot, 0.4), 0.01);
  DropLimits(robot.measured, "it was painted");
  EXPECT_EQ(TrustedStep(robot, 0.8), 0.013);
  EXPECT_EQ(robot.measured.why_unused, "it was painted");
}

// Terrain that a robot without limits drives over is an obstacle to one that cannot cross it, and
// blind objects stay obstacles.
TEST(MeasuredLimits, JudgeAMap) {
  HazardMap map;
  map.hazards = {OfSizes({{{"rough", 0.02}}}), OfSizes({{{"rough", 0.005}}}),
                 OfSizes({{{"groove", 0.02}}}), OfSizes({})};
  map.hazards[3].hazard_class = HazardClass::kBlindObject;
  RobotSpec robot;
  for (const Hazard& hazard : JudgedFor(map, robot).hazards) EXPECT_FALSE(hazard.crossable);
  robot.measured = Measured({{"rough", {0.01, 0.01}}});
  const HazardMap dut = JudgedFor(map, robot);
  EXPECT_TRUE(IsObstacle(dut.hazards[0], 0.05));
  EXPECT_FALSE(IsObstacle(dut.hazards[1], 0.05));
  EXPECT_FALSE(IsObstacle(dut.hazards[2], 0.05));
  EXPECT_TRUE(IsObstacle(dut.hazards[3], 0.05));
}

// A ramp that is too steep leads nowhere.
TEST(MeasuredLimits, LevelsAreNotReachedByRampsThatAreTooSteep) {
  const double slope_rad = std::atan(0.1);
  Hazard ramp = OfSizes({{{"ramp", slope_rad}, {"ramp_down", slope_rad}}});
  ramp.footprint = {Rectangle({0, 0}, {1, 1})};
  ramp.solids = {{Solid::Kind::kPrism, ramp.footprint[0], {}, 0, 0.1, Vec2(0.1, 0)}};
  Hazard level = OfSizes(LevelSizes(0.1));
  level.hazard_class = HazardClass::kLevelChange;
  level.height_m = 0.1;
  level.footprint = {Rectangle({1, 0}, {2, 1})};
  HazardMap map;
  map.hazards = {ramp, level};
  RobotSpec robot;
  const auto opened = [&] {
    const HazardMap floor = OpenByRamps(JudgedFor(map, robot), 0.01);
    return std::ranges::none_of(floor.hazards, [](const Hazard& h) {
      return h.footprint[0] == Rectangle({1, 0}, {2, 1}) && IsObstacle(h, 0.01);
    });
  };
  EXPECT_TRUE(opened());
  robot.measured = Measured({{"ramp", {0.2, 0.2}}, {"ramp_down", {0.2, 0.2}}});
  EXPECT_TRUE(opened());
  robot.measured = Measured({{"ramp", {0.2, 0.2}}, {"ramp_down", {0.05, 0.05}}});
  EXPECT_FALSE(opened());
}

}  // namespace
}  // namespace floorproof
