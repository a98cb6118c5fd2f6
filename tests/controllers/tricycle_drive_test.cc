// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "controllers/drive.h"
#include "tests/controllers/driving.h"

namespace floorproof {
namespace {

constexpr double kBase_m = 0.5, kRadius_m = 0.1, kMost_rad = 1.1;

RobotSpec Tricycle(double base_m = kBase_m) {
  RobotSpec robot = RoundRobot();
  robot.drive = "tricycle";
  robot.wheels.resize(1);
  robot.wheels[0].p_BW = {base_m, 0, kRadius_m};
  robot.wheels[0].radius_m = kRadius_m;
  robot.steering = {"fork", 0, -kMost_rad, kMost_rad, 2};
  robot.turn_radius_m = std::abs(base_m) / std::tan(kMost_rad);
  return robot;
}

std::unique_ptr<Drive> Configured(const RobotSpec& robot) {
  auto dut = MakePlugin(Drives(), "tricycle", "drive");
  dut->Configure(robot);
  return dut;
}

HingeState Pointing(double heading_rad) {
  HingeState state;
  state.steered = true;
  state.steer_rad = heading_rad;
  return state;
}

// The fork turned as far as it is told to.
BodyTwist Settled(const Drive& dut, const BodyTwist& asked) {
  HingeState fork = Pointing(0);
  double wheel[1];
  for (int k = 0; k < 500; ++k) {
    dut.ToWheels(asked, fork, wheel);
    fork.steer_rad += 0.02 * fork.steer_radps;
  }
  return dut.ToTwist(wheel, fork);
}

//        ^ the wheel rolls along d, the axle along x: both are square to the radius,
//   L   /    so tan(d) = L / R
// ==+------ d
TEST(TricycleDrive, TurnsAboutWhereTheAxesMeet) {
  const auto dut = Configured(Tricycle());
  for (const double d : {0.3, -0.3, 0.9}) {
    const double wheel[] = {2.0};
    const BodyTwist v = dut->ToTwist(wheel, Pointing(d));
    EXPECT_NEAR(v.vx_mps / v.wz_radps, kBase_m / std::tan(d), 1e-12);
    EXPECT_NEAR(std::hypot(v.vx_mps, kBase_m * v.wz_radps), 2 * kRadius_m, 1e-12) << "rim's speed";
    EXPECT_EQ(v.vy_mps, 0) << "the axle does not slide";
  }
}

TEST(TricycleDrive, GivesTheTwistThatIsAskedFor) {
  for (const double base_m : {kBase_m, -kBase_m}) {  // steered before the axle, or behind it
    const auto dut = Configured(Tricycle(base_m));
    for (const BodyTwist& asked :
         {BodyTwist{0.3, 0, 0.4}, BodyTwist{0.3, 0, -0.4}, BodyTwist{-0.2, 0, 0.3}}) {
      const BodyTwist got = Settled(*dut, asked);
      EXPECT_NEAR(got.vx_mps, asked.vx_mps, 1e-6);
      EXPECT_NEAR(got.wz_radps, asked.wz_radps, 1e-6);
    }
  }
}

TEST(TricycleDrive, ClipsTheCurvatureAtItsStopsAndKeepsTheSpeed) {
  const RobotSpec robot = Tricycle();
  const auto dut = Configured(robot);
  const BodyTwist left = Settled(*dut, {0.1, 0, 5}), right = Settled(*dut, {0.1, 0, -5});
  EXPECT_NEAR(left.vx_mps, 0.1, 1e-9);
  EXPECT_NEAR(left.vx_mps / left.wz_radps, robot.turn_radius_m, 1e-9);
  EXPECT_NEAR(right.wz_radps, -left.wz_radps, 1e-9);
}

// Before the fork is there, the wheel rolls along where it points, no faster than asked for; far
// off it stands until the fork has come.
TEST(TricycleDrive, SteersBeforeItDrives) {
  const auto dut = Configured(Tricycle());
  const BodyTwist asked{0.3, 0, 0.6};
  const double wanted_rad = std::atan(kBase_m * asked.wz_radps / asked.vx_mps);
  HingeState fork = Pointing(0);
  double wheel[1], last_mps = -1;
  dut->ToWheels(asked, fork, wheel);
  EXPECT_EQ(wheel[0], 0);
  EXPECT_GT(fork.steer_radps, 0);
  for (int k = 0; k < 200; ++k) {
    dut->ToWheels(asked, fork, wheel);
    EXPECT_LE(std::abs(fork.steer_radps), 2 + 1e-12) << "no faster than its motor";
    const double ahead_mps = dut->ToTwist(wheel, fork).vx_mps;
    EXPECT_GE(ahead_mps, last_mps - 1e-12);
    EXPECT_LE(ahead_mps, asked.vx_mps + 1e-12);
    last_mps = ahead_mps;
    fork.steer_rad += 0.02 * fork.steer_radps;
  }
  EXPECT_NEAR(fork.steer_rad, wanted_rad, 1e-6);
}

TEST(TricycleDrive, KeepsItsHeadingWhereItStands) {
  const auto dut = Configured(Tricycle());
  HingeState fork = Pointing(0.7);
  double wheel[1];
  for (const double turn : {0.0, 0.5}) {
    dut->ToWheels({0, 0, turn}, fork, wheel);
    EXPECT_EQ(fork.steer_radps, 0);
    EXPECT_EQ(wheel[0], 0);
  }
}

TEST(TricycleDrive, TheMotorsLimitKeepsTheCurvature) {
  RobotSpec robot = Tricycle();
  robot.wheels[0].max_speed_radps = 1;
  const BodyTwist got = Settled(*Configured(robot), {0.4, 0, 0.4});
  EXPECT_LT(got.vx_mps, 0.11);
  EXPECT_NEAR(got.wz_radps / got.vx_mps, 1, 1e-6);
}

TEST(TricycleDrive, RefusesRobotsItCannotDrive) {
  const auto refused = [](const std::function<void(RobotSpec&)>& spoil, const std::string& why) {
    RobotSpec robot = Tricycle();
    spoil(robot);
    try {
      Configured(robot);
      ADD_FAILURE() << why;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(why));
    }
  };
  refused([](RobotSpec& r) { r.wheels.push_back(r.wheels[0]); }, "needs one driven wheel, not 2");
  refused([](RobotSpec& r) { r.steering.reset(); }, "needs a motor that steers its wheel");
  refused([](RobotSpec& r) { r.wheels[0].p_BW.y() = 0.1; }, "middle line");
  refused([](RobotSpec& r) { r.wheels[0].p_BW.x() = 0; }, "before or behind the axle");
  refused([](RobotSpec& r) { r.wheels[0].radius_m = 0; }, "no radius");
  refused([](RobotSpec& r) { r.wheels[0].max_speed_radps = std::nan(""); }, "no top speed");
  refused([](RobotSpec& r) { r.wheels[0].roller_angle_rad = 0.7; }, "rollers");
  refused([](RobotSpec& r) { r.steering->max_rate_radps = 0; }, "no rate");
}

}  // namespace
}  // namespace floorproof
