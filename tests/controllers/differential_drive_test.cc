// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/controllers/driving.h"

namespace floorproof {
namespace {

std::unique_ptr<Drive> Configured(const RobotSpec& robot) {
  auto dut = MakePlugin(Drives(), "differential", "drive");
  dut->Configure(robot);
  return dut;
}

TEST(DifferentialDrive, TwistAndWheelsAreInverse) {
  const auto dut = Configured(RoundRobot());
  double wheels[2];
  for (const BodyTwist v : {BodyTwist{0.2, 0, 0}, {0, 0, 1}, {-0.1, 0, 0.4}, {0.25, 0, -0.7}}) {
    dut->ToWheels(v, wheels);
    const BodyTwist back = dut->ToTwist(wheels);
    EXPECT_NEAR(back.vx_mps, v.vx_mps, 1e-15);
    EXPECT_NEAR(back.vy_mps, 0, 1e-15);
    EXPECT_NEAR(back.wz_radps, v.wz_radps, 1e-15);
  }
}

TEST(DifferentialDrive, WheelsRollWhatTheirPlaceMoves) {
  const auto dut = Configured(RoundRobot());
  double wheels[2];
  dut->ToWheels({0.2, 0, 0}, wheels);  // v / r
  EXPECT_DOUBLE_EQ(wheels[0], 0.2 / 0.05);
  EXPECT_DOUBLE_EQ(wheels[1], 0.2 / 0.05);
  dut->ToWheels({0, 0, 1}, wheels);  // turning left: the left wheel backwards, w y / r
  EXPECT_DOUBLE_EQ(wheels[0], -0.12 / 0.05);
  EXPECT_DOUBLE_EQ(wheels[1], 0.12 / 0.05);
}

TEST(DifferentialDrive, UnequalRadiiStillDriveStraight) {
  RobotSpec robot = RoundRobot();
  robot.wheels[1].radius_m = 0.04;
  const auto dut = Configured(robot);
  double wheels[2];
  dut->ToWheels({0.2, 0, 0}, wheels);
  EXPECT_DOUBLE_EQ(wheels[0] * 0.05, wheels[1] * 0.04);
  EXPECT_NEAR(dut->ToTwist(wheels).wz_radps, 0, 1e-15);
}

TEST(DifferentialDrive, TheMotorsLimitKeepsTheCurvature) {
  const auto dut = Configured(RoundRobot());
  const BodyTwist wanted{2.0, 0, 3.0};
  double wheels[2];
  dut->ToWheels(wanted, wheels);
  EXPECT_NEAR(std::max(std::abs(wheels[0]), std::abs(wheels[1])), 12, 1e-12);
  const BodyTwist got = dut->ToTwist(wheels);
  EXPECT_LT(got.vx_mps, wanted.vx_mps);
  EXPECT_NEAR(got.wz_radps / got.vx_mps, wanted.wz_radps / wanted.vx_mps, 1e-12);
}

TEST(DifferentialDrive, SidewaysIsDropped) {
  const auto dut = Configured(RoundRobot());
  double with[2], without[2];
  dut->ToWheels({0.1, 0.3, 0.2}, with);
  dut->ToWheels({0.1, 0, 0.2}, without);
  EXPECT_THAT(with, testing::ElementsAreArray(without));
}

TEST(DifferentialDrive, AnAxleAheadSwingsTheOriginSideways) {
  RobotSpec robot = RoundRobot();
  for (WheelSpec& wheel : robot.wheels) wheel.p_BW.x() = 0.1;
  const auto dut = Configured(robot);
  double wheels[2];
  dut->ToWheels({0, 0, 1}, wheels);
  EXPECT_NEAR(dut->ToTwist(wheels).vy_mps, -0.1, 1e-15);
}

TEST(DifferentialDrive, RefusesRobotsItCannotDrive) {
  const auto refused = [](const std::function<void(RobotSpec&)>& spoil, const char* why) {
    RobotSpec robot = RoundRobot();
    spoil(robot);
    try {
      Configured(robot);
      ADD_FAILURE() << "accepted, though: " << why;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(why));
    }
  };
  refused([](RobotSpec& r) { r.wheels.pop_back(); }, "needs two driven wheels");
  refused([](RobotSpec& r) { r.wheels[0].radius_m = 0; }, "no radius");
  refused([](RobotSpec& r) { r.wheels[1].max_speed_radps = std::nan(""); }, "no top speed");
  refused([](RobotSpec& r) { r.wheels[1].p_BW.y() = r.wheels[0].p_BW.y(); }, "same y");
  refused([](RobotSpec& r) { r.wheels[1].roller_angle_rad = 0.785; }, "rollers");
}

}  // namespace
}  // namespace floorproof
