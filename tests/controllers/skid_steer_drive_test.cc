// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "tests/controllers/driving.h"

namespace floorproof {
namespace {

constexpr double kA_m = 0.2, kB_m = 0.25, kRadius_m = 0.08;

RobotSpec SkidSteer(const std::vector<double>& axles_x_m) {
  RobotSpec robot = RoundRobot();
  robot.name = "skid";
  robot.drive = "skid_steer";
  robot.wheels.clear();
  for (const double x : axles_x_m)
    for (const double y : {kB_m, -kB_m}) {
      WheelSpec wheel;
      wheel.name = "wheel " + std::to_string(robot.wheels.size());
      wheel.p_BW = {x, y, kRadius_m};
      wheel.radius_m = kRadius_m;
      wheel.max_speed_radps = 30;
      robot.wheels.push_back(wheel);
    }
  return robot;
}
const RobotSpec kFour = SkidSteer({kA_m, -kA_m}), kSix = SkidSteer({kA_m, 0, -kA_m});

std::unique_ptr<Drive> Configured(const RobotSpec& robot) {
  auto dut = MakePlugin(Drives(), "skid_steer", "drive");
  dut->Configure(robot);
  return dut;
}

// The speed of the rims, left back and right ahead, that turns it by 1 rad/s: its half track, as if
// no wheel slid.
double HalfTrack(const RobotSpec& robot) {
  std::vector<double> wheels(robot.wheels.size());
  for (std::size_t i = 0; i < wheels.size(); ++i)
    wheels[i] = (robot.wheels[i].p_BW.y() > 0 ? -1 : 1) / robot.wheels[i].radius_m;
  return 1 / Configured(robot)->ToTwist(wheels).wz_radps;
}

TEST(SkidSteerDrive, FourWheelsTurnAsOnAWiderTrack) {
  EXPECT_NEAR(HalfTrack(kFour), kB_m + kA_m * kA_m / kB_m, 1e-12);
  // With the axles together it is a differential drive.
  EXPECT_NEAR(HalfTrack(SkidSteer({1e-6, -1e-6})), kB_m, 1e-9);
}

// The moment of what the wheels slide along is that of what they slide across.
TEST(SkidSteerDrive, SixWheelsBalanceTheirMoments) {
  double low = 0, high = kA_m * kA_m / kB_m;
  for (int i = 0; i < 60; ++i) {
    const double s = (low + high) / 2;
    (2 * (kA_m * kA_m - kB_m * s) > kB_m * std::hypot(kA_m, s) ? low : high) = s;
  }
  EXPECT_NEAR(HalfTrack(kSix), kB_m + low, 1e-9);
  EXPECT_LT(HalfTrack(kSix), HalfTrack(kFour)) << "middle wheels hardly slide across";
  // So short that the middle wheels hold their sides: they roll.
  EXPECT_NEAR(HalfTrack(SkidSteer({0.1, 0, -0.1})), kB_m, 1e-6);
}

// Of wheels and loads as they come: forces along, across and the moment add up to nothing.
TEST(SkidSteerDrive, FrictionIsInBalance) {
  for (const Vec2& com : {Vec2(0, 0), Vec2(0.05, 0), Vec2(-0.04, 0.03), Vec2(0, -0.1)}) {
    RobotSpec robot = kFour;
    robot.p_BCom = {com.x(), com.y(), 0.1};
    const auto dut = Configured(robot);
    // On four alike springs: a plane over their places.
    std::vector<double> wheels(4);
    dut->ToWheels({0.1, 0, 1}, wheels);
    const BodyTwist v = dut->ToTwist(wheels);
    EXPECT_NEAR(v.vx_mps, 0.1, 1e-12);
    EXPECT_NEAR(v.wz_radps, 1, 1e-12);
    double along = 0, across = 0, moment = 0, moved = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec2 p = robot.wheels[i].p_BW.head<2>();
      const double load =
          0.25 * (1 + com.x() * p.x() / (kA_m * kA_m) + com.y() * p.y() / (kB_m * kB_m));
      const Vec2 slide(v.vx_mps - v.wz_radps * p.y() - wheels[i] * kRadius_m,
                       v.vy_mps + v.wz_radps * p.x());
      const Vec2 force = -load * slide.normalized();
      along += force.x();
      across += force.y();
      moment += Cross(p, force);
      moved += load;
    }
    EXPECT_NEAR(moved, 1, 1e-12);
    EXPECT_NEAR(along, 0, 1e-6) << com.transpose();
    EXPECT_NEAR(across, 0, 1e-6) << com.transpose();
    EXPECT_NEAR(moment, 0, 1e-6) << com.transpose();
  }
}

// A nose-heavy one turns about a point ahead of its middle.
TEST(SkidSteerDrive, TurnsAboutWhereItsWeightIs) {
  RobotSpec robot = kFour;
  robot.p_BCom.x() = 0.05;
  std::vector<double> wheels(4);
  const auto dut = Configured(robot);
  dut->ToWheels({0, 0, 1}, wheels);
  const BodyTwist ahead = dut->ToTwist(wheels);
  EXPECT_LT(ahead.vy_mps, -0.05);
  robot.p_BCom.x() = -0.05;
  const auto behind = Configured(robot);
  behind->ToWheels({0, 0, 1}, wheels);
  EXPECT_NEAR(behind->ToTwist(wheels).vy_mps, -ahead.vy_mps, 1e-12);
}

TEST(SkidSteerDrive, OdometryGoesOnWithTheOtherWheelsOfTheSide) {
  for (const RobotSpec& robot : {kFour, kSix}) {
    const auto dut = Configured(robot);
    const std::size_t n = robot.wheels.size();
    std::vector<double> wheels(n);
    const BodyTwist wanted{0.2, 0, -0.3};
    dut->ToWheels(wanted, wheels);
    std::vector<char> out(n, 0);
    out[0] = 1;     // left
    wheels[0] = 0;  // its encoder is dead
    EXPECT_GT(std::abs(dut->ToTwist(wheels).wz_radps - wanted.wz_radps), 0.05);
    ASSERT_TRUE(dut->Exclude(out));
    EXPECT_NEAR(dut->ToTwist(wheels).vx_mps, wanted.vx_mps, 1e-12);
    EXPECT_NEAR(dut->ToTwist(wheels).wz_radps, wanted.wz_radps, 1e-12);
    std::vector<double> told(n);
    dut->ToWheels(wanted, told);
    EXPECT_NEAR(told[0], told[2], 1e-12) << "it is told to turn along";
    // One a side still moves it every way; a side without any does not.
    for (std::size_t i = 0; i + 2 < n; ++i) out[i] = 1;
    EXPECT_TRUE(dut->Exclude(out));
    out[n - 2] = 1;
    EXPECT_FALSE(dut->Exclude(out));
    dut->ToWheels(wanted, told);
    EXPECT_NEAR(dut->ToTwist(told).wz_radps, wanted.wz_radps, 1e-12) << "nothing has changed";
  }
}

TEST(SkidSteerDrive, AMotorOutOfUseBoundsNothing) {
  RobotSpec robot = kFour;
  robot.wheels[0].max_speed_radps = 1;
  const auto dut = Configured(robot);
  std::vector<double> wheels(4);
  dut->ToWheels({0.4, 0, 0}, wheels);
  EXPECT_NEAR(wheels[2], 1, 1e-12) << "all are slowed down to what the slowest can";
  ASSERT_TRUE(dut->Exclude(std::vector<char>{1, 0, 0, 0}));
  dut->ToWheels({0.4, 0, 0}, wheels);
  EXPECT_NEAR(wheels[2], 0.4 / kRadius_m, 1e-12);
}

TEST(SkidSteerDrive, TheMotorsLimitKeepsTheCurvature) {
  const auto dut = Configured(kFour);
  const BodyTwist wanted{3, 0, 4};
  std::vector<double> wheels(4);
  dut->ToWheels(wanted, wheels);
  EXPECT_NEAR(std::abs(*std::ranges::max_element(wheels, {}, [](double w) { return std::abs(w); })),
              30, 1e-12);
  const BodyTwist got = dut->ToTwist(wheels);
  EXPECT_NEAR(got.wz_radps / got.vx_mps, wanted.wz_radps / wanted.vx_mps, 1e-12);
}

TEST(SkidSteerDrive, RefusesRobotsItCannotDrive) {
  const auto refused = [](const std::function<void(RobotSpec&)>& spoil, const char* why) {
    RobotSpec robot = kFour;
    spoil(robot);
    try {
      Configured(robot);
      ADD_FAILURE() << "accepted, though: " << why;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(why));
    }
  };
  refused([](RobotSpec& r) { r.wheels.pop_back(); },
          "needs two or more driven wheels on each side, not 2 on the left and 1 on the right");
  refused([](RobotSpec& r) { r.wheels[1].p_BW.y() = 0; }, "stands neither left nor right");
  refused([](RobotSpec& r) { r.wheels[2].yaw_rad = kPi; }, "does not point ahead");
  refused([](RobotSpec& r) { r.wheels[0].radius_m = 0; }, "no radius");
  refused([](RobotSpec& r) { r.wheels[1].max_speed_radps = std::nan(""); }, "no top speed");
  refused([](RobotSpec& r) { r.wheels[1].roller_angle_rad = 0.785; }, "rollers");
}

}  // namespace
}  // namespace floorproof
