// SPDX-License-Identifier: Apache-2.0
#include "validate/robot_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/robot_file.h"
#include "tests/validate/two_wheels.h"
#include "tests/validate/wrongs.h"

namespace floorproof {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

std::vector<std::string> Wrongs(const TwoWheels& robot) {
  return Wrongs(CheckRobot(RobotFile(Mjcf(robot)).path()));
}

const LawRow& Row(const RobotDrive& drive, std::string_view name) {
  const auto row = std::ranges::find(drive.rows, name, &LawRow::law);
  EXPECT_NE(row, drive.rows.end()) << name;
  return *row;
}

TEST(RobotCheck, NothingIsWrongWithTheBundledRobots) {
  for (const RobotEntry& robot : Robots())
    EXPECT_THAT(Wrongs(CheckRobot(std::string(robot.name))), IsEmpty()) << robot.name;
}

TEST(RobotCheck, NothingIsWrongWithABaseOnTwoWheels) {
  EXPECT_THAT(Wrongs(TwoWheels{}), IsEmpty());
}

// Every number of this model is finite; gravity throws a weight upwards, beyond what MuJoCo
// follows.
TEST(RobotCheck, NamesWhatDiverges) {
  std::string text = Mjcf({});
  const std::string joint = "<freejoint/>";
  ASSERT_NE(text.find(joint), text.npos);
  text.insert(text.find(joint) + joint.size(),
              "<body name='arm' gravcomp='5e8'><joint name='lift' type='slide' axis='0 0 1'/>"
              "<geom size='0.01' mass='1e-3' contype='0' conaffinity='0'/></body>");
  const RobotFile file(text);
  try {
    CheckRobot(file.path());
    FAIL() << "the physics did not diverge";
  } catch (const InternalError& e) {
    EXPECT_THAT(e.what(), HasSubstr("on the rig: body 'arm' (joint 'lift') at "));
  }
}

// Whether the drive would tell a robot from another one: larger wheels roll farther, and turn it
// farther, on wheels that slip it stays behind.
TEST(RobotDrive, NoticesAWrongModel) {
  const RobotFile file(Mjcf({}));
  const RobotDrive larger = DriveTenSeconds(file.path(), kLargerWheels);
  EXPECT_FALSE(Row(larger, "straight/way").ok());
  EXPECT_GT(Row(larger, "straight/way").measured, Row(larger, "straight/way").expected);
  const RobotDrive slippery = DriveTenSeconds(file.path(), {.friction_factor = 0.01});
  EXPECT_FALSE(Row(slippery, "straight/way").ok());
  EXPECT_THAT(slippery.straight_hint, HasSubstr("they slip"));
}

// Whether it is the motors or the grip.
TEST(RobotDrive, SaysWhyItStaysBehind) {
  const RobotDrive soft = DriveTenSeconds(RobotFile(Mjcf({.driver_gain = 0.02})).path());
  EXPECT_THAT(soft.straight_hint, HasSubstr("the motors do not hold the speed"));
  EXPECT_THAT(soft.turn_hint, HasSubstr("hold the motors back"));
  const RobotDrive slippery =
      DriveTenSeconds(RobotFile(Mjcf({})).path(), {.friction_factor = 0.005});
  EXPECT_THAT(slippery.straight_hint, HasSubstr("they slip, with"));
}

TEST(RobotDrive, ItTakesTenSecondsAndTheSameRowsEachTime) {
  const RobotFile file(Mjcf({}));
  const RobotDrive one = DriveTenSeconds(file.path()), again = DriveTenSeconds(file.path());
  ASSERT_EQ(one.rows.size(), again.rows.size());
  for (std::size_t i = 0; i < one.rows.size(); ++i)
    EXPECT_EQ(one.rows[i].measured, again.rows[i].measured) << one.rows[i].law;
  // By hand: 0.2 m/s from 0.5 to 4 s, reached at 0.5 m/s^2.
  EXPECT_NEAR(Row(one, "straight/way").expected, 0.2 * 3.5 - 0.2 * 0.2 / (2 * 0.5), 0.002);
  EXPECT_NEAR(Row(one, "brake/way").expected, 0.2 * 0.2 / (2 * 0.5), 1e-9);
}

// The weight on the wheels, from where the centre of mass stands between axle and caster.
TEST(RobotDrive, TheWeightStandsOnWheelsAndCasterByTheLever) {
  const RobotCheck dut = CheckRobot(RobotFile(Mjcf({})).path());
  EXPECT_NEAR(dut.drive.driven_share, 1 - dut.spec.p_BCom.x() / -0.12, 0.02);
  const double caster_n = (1 - dut.drive.driven_share) * dut.spec.mass_kg * 9.81;
  EXPECT_NEAR(dut.drive.rolling_n, 2 * 0.01 / 0.05 + 0.02 * caster_n, 0.03);
}

// Motor: slope stall / no load; at the rim less what rolls.
TEST(RobotCheck, TheTopSpeedIsWhereTheMotorsHoldRollingFriction) {
  const RobotCheck dut = CheckRobot(RobotFile(Mjcf({})).path());
  const double slope = 2.0 / 10, load_nm = dut.drive.rolling_n * 0.05 / 2;
  EXPECT_NEAR(dut.top_speed_mps, 0.05 * (2.0 - load_nm) / (slope + 0.001), 1e-3);
  EXPECT_NEAR(dut.top_yaw_radps, dut.top_speed_mps / 0.1, 1e-3);
  EXPECT_NEAR(dut.track_m, 0.2, 1e-9);
  EXPECT_NEAR(dut.stall_force_n, 2 * 2 / 0.05, 1e-6);
}

TEST(RobotCheck, WheelsOffTheFloorAreNoticed) {
  EXPECT_THAT(Wrongs({.wheel_z_m = 0.054}),
              Contains(HasSubstr("the driven wheel left hangs 4 mm over the floor")));
  EXPECT_THAT(Wrongs({.wheel_z_m = 0.046}),
              Contains(HasSubstr("left reaches 4 mm into the floor")));
  EXPECT_THAT(Wrongs({.wheel_z_m = 0.0505}), Not(Contains(HasSubstr("over the floor"))));
}

TEST(RobotCheck, AnInertiaThatNoSuchBodyCanHaveIsNoticed) {
  const auto with = [](const char* inertia) {
    return Wrongs({.base_inertial = "<inertial pos=\"-0.03 0 0.08\" mass=\"4\" diaginertia=\"" +
                                    std::string(inertia) + "\"/>"});
  };
  EXPECT_THAT(with("0.01 0.02 0.025"), IsEmpty());
  EXPECT_THAT(with("-0.01 0.02 0.02"), Contains(HasSubstr("a principal moment of 0")));
  EXPECT_THAT(with("0.5 0.5 0.5"), Contains(StartsWith("wrong: the inertia of base, 0.5 kg m2")));
}

TEST(RobotCheck, MotorsThatCannotMoveItAreNoticed) {
  EXPECT_THAT(Wrongs({.stall_nm = 0.005}), Contains(HasSubstr("the motors cannot move it")));
  EXPECT_THAT(Wrongs({.stall_nm = 0.05}), Contains(HasSubstr("max_accel_mps2 asks for")));
  EXPECT_THAT(Wrongs({.max_speed_mps = 0.6}),
              Contains(HasSubstr("max_speed_mps 0.6 is more than the motors reach")));
}

TEST(RobotCheck, WhatItCannotHoldIsNoticed) {
  EXPECT_THAT(Wrongs({.caster_friction = 3}), Contains(HasSubstr("grip")));
  EXPECT_THAT(Wrongs({.max_accel_mps2 = 9}), Contains(HasSubstr("goes over an edge")));
  EXPECT_THAT(Wrongs({.step_m = 0.05}), Contains(HasSubstr("belly's clearance, 30 mm")));
}

TEST(RobotCheck, ASupportThatDoesNotHoldTheCentreOfMassIsRefused) {
  try {
    CheckRobot(RobotFile(Mjcf({.caster_x_m = 0.12})).path());
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("outside the wheels' support, by "));
    EXPECT_THAT(e.what(), HasSubstr("mm: move a mass"));
  }
}

}  // namespace
}  // namespace floorproof
