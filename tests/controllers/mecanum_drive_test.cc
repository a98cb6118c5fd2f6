// SPDX-License-Identifier: Apache-2.0
// The Mecanum drive against the law of a single wheel, derived here a second time from its
// geometry: the rim's point at the floor may move only across the roller's axis.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "env/core/blocks.h"
#include "tests/controllers/driving.h"

namespace floorproof {
namespace {

std::unique_ptr<Drive> MakeDut(const RobotSpec& robot) {
  auto dut = MakePlugin(Drives(), "mecanum", "drive");
  dut->Configure(robot);
  return dut;
}

std::vector<double> Wheels(const Drive& dut, const BodyTwist& twist, std::size_t n = 4) {
  std::vector<double> wheels(n);
  dut.ToWheels(twist, wheels);
  return wheels;
}

TEST(MecanumDrive, NoRollerIsDraggedAlongItsAxis) {
  const RobotSpec robot = HolonomicRobot();
  const auto dut = MakeDut(robot);
  for (const BodyTwist& twist : {BodyTwist{0.2, 0, 0}, BodyTwist{0, 0.2, 0}, BodyTwist{0, 0, 0.7},
                                 BodyTwist{0.1, -0.2, 0.3}}) {
    const auto wheels = Wheels(*dut, twist);
    for (std::size_t i = 0; i < robot.wheels.size(); ++i) {
      const WheelSpec& w = robot.wheels[i];
      const Vec2 hub(twist.vx_mps - twist.wz_radps * w.p_BW.y(),
                     twist.vy_mps + twist.wz_radps * w.p_BW.x());
      const Vec2 rim = hub - Vec2(wheels[i] * w.radius_m, 0);  // at the floor it runs backwards
      const Vec2 axis(-std::sin(w.roller_angle_rad), std::cos(w.roller_angle_rad));
      EXPECT_NEAR(rim.dot(axis), 0, 1e-12) << w.name;
    }
  }
}

TEST(MecanumDrive, ForwardIsAllWheelsAlikeSidewaysIsCrossed) {
  const auto dut = MakeDut(HolonomicRobot());
  for (const double speed : Wheels(*dut, {0.2, 0, 0})) EXPECT_NEAR(speed, 4, 1e-12);
  const auto left = Wheels(*dut, {0, 0.2, 0});  // front left, front right, rear left, rear right
  EXPECT_NEAR(left[0], -4, 1e-12);
  EXPECT_NEAR(left[1], 4, 1e-12);
  EXPECT_NEAR(left[2], 4, 1e-12);
  EXPECT_NEAR(left[3], -4, 1e-12);
}

TEST(MecanumDrive, ThereAndBack) {
  const auto dut = MakeDut(HolonomicRobot());
  const BodyTwist twist{0.1, -0.15, 0.4};
  const BodyTwist back = dut->ToTwist(Wheels(*dut, twist));
  EXPECT_NEAR(back.vx_mps, twist.vx_mps, 1e-12);
  EXPECT_NEAR(back.vy_mps, twist.vy_mps, 1e-12);
  EXPECT_NEAR(back.wz_radps, twist.wz_radps, 1e-12);
}

TEST(MecanumDrive, TooFastIsScaledAsAWhole) {
  const RobotSpec robot = HolonomicRobot();
  const auto dut = MakeDut(robot);
  const BodyTwist twist{2, 1, 3};
  const auto wheels = Wheels(*dut, twist);
  double fastest = 0;
  for (const double speed : wheels) fastest = std::max(fastest, std::abs(speed));
  EXPECT_NEAR(fastest, robot.wheels[0].max_speed_radps, 1e-9);
  const BodyTwist kept = dut->ToTwist(wheels);
  EXPECT_NEAR(kept.vy_mps / kept.vx_mps, 0.5, 1e-9);
  EXPECT_NEAR(kept.wz_radps / kept.vx_mps, 1.5, 1e-9);
}

TEST(MecanumDrive, RefusesWheelsThatCannot) {
  auto dut = MakePlugin(Drives(), "mecanum", "drive");
  EXPECT_THROW(dut->Configure(RoundRobot()), InputError) << "two plain wheels";
  RobotSpec one_handed = HolonomicRobot();
  for (WheelSpec& w : one_handed.wheels) w.roller_angle_rad = kPi / 4;
  EXPECT_THROW(dut->Configure(one_handed), InputError) << "moves obliquely only";
  RobotSpec plain = HolonomicRobot();
  plain.wheels[2].roller_radius_m = 0;
  EXPECT_THROW(dut->Configure(plain), InputError);
}

// Two blocks on a hinge, two wheels on each.
RobotSpec HingedRobot() {
  RobotSpec robot = HolonomicRobot();
  robot.blocks = {{"right", Rectangle({-0.2, -0.2}, {0.2, 0}), {0, -0.1}},
                  {"left", Rectangle({-0.2, 0}, {0.2, 0.2}), {0, 0.1}}};
  robot.hinges = {{"hinge", 0, 1, {0.2, 0}, -1, 0, 0, kPi, 1}};
  robot.shapes = {{"square", {0.0}, {}, 0}};
  for (WheelSpec& wheel : robot.wheels) wheel.block = wheel.p_BW.y() > 0;
  return robot;
}

TEST(MecanumDrive, ThereAndBackWhileABlockSwings) {
  const RobotSpec robot = HingedRobot();
  const auto dut = MakeDut(robot);
  HingeState hinges = AtRest(std::vector{0.6});
  hinges.radps[0] = 0.4;
  const BodyTwist twist{0.1, -0.15, 0.4};
  std::vector<double> wheels(robot.wheels.size());
  dut->ToWheels(twist, hinges, wheels);
  EXPECT_EQ(hinges.radps[0], 0.4) << "no wheel is too slow";
  const BodyTwist back = dut->ToTwist(wheels, hinges);
  EXPECT_NEAR(back.vx_mps, twist.vx_mps, 1e-12);
  EXPECT_NEAR(back.vy_mps, twist.vy_mps, 1e-12);
  EXPECT_NEAR(back.wz_radps, twist.wz_radps, 1e-12);
}

TEST(MecanumDrive, WheelsTooSlowSlowTheHingesToo) {
  const RobotSpec robot = HingedRobot();
  const auto dut = MakeDut(robot);
  HingeState hinges = AtRest(std::vector{0.6});
  hinges.radps[0] = 20;
  std::vector<double> wheels(robot.wheels.size());
  dut->ToWheels({2, 1, 3}, hinges, wheels);
  EXPECT_LT(hinges.radps[0], 20);
  const double share = hinges.radps[0] / 20;
  const BodyTwist kept = dut->ToTwist(wheels, hinges);
  EXPECT_NEAR(kept.vx_mps, 2 * share, 1e-9);
  EXPECT_NEAR(kept.wz_radps, 3 * share, 1e-9);
}

// While the second block swings, its wheels roll with it.
TEST(MecanumDrive, WheelsOfASwingingBlockRollAlong) {
  const RobotSpec robot = HingedRobot();
  const auto dut = MakeDut(robot);

  constexpr double kAngle = 0.6, kRate = 0.4, kDt = 1e-6;
  HingeState now = AtRest(std::vector{kAngle}), then = AtRest(std::vector{kAngle + kRate * kDt});
  now.radps[0] = kRate;
  std::vector<double> wheels(robot.wheels.size());
  dut->ToWheels({}, now, wheels);
  const BlockMotions before = MoveBlocks(robot.blocks, robot.hinges, now);
  const BlockMotions after = MoveBlocks(robot.blocks, robot.hinges, then);
  const Vec2 start_B = MoveBlocks(robot.blocks, robot.hinges, StartState(robot)).p_RB;
  for (std::size_t i = 0; i < robot.wheels.size(); ++i) {
    const WheelSpec& w = robot.wheels[i];
    const auto block = static_cast<std::size_t>(w.block);
    const Vec2 p_K = w.p_BW.head<2>() + start_B;
    const Vec2 hub_B = (after.block[block].X_BK * p_K - before.block[block].X_BK * p_K) / kDt;
    const Vec2 hub = Pose2{0, 0, -before.block[block].X_BK.yaw_rad}.Rotate(hub_B);
    const Vec2 rim = hub - Vec2(wheels[i] * w.radius_m, 0);
    const Vec2 axis(-std::sin(w.roller_angle_rad), std::cos(w.roller_angle_rad));
    EXPECT_NEAR(rim.dot(axis), 0, 1e-6) << w.name;
    EXPECT_GT(hub.norm(), 0.005) << "it moves";
  }
}

}  // namespace
}  // namespace floorproof
