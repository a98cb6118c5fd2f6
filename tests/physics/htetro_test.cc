// SPDX-License-Identifier: Apache-2.0
// hTetro on its Mecanum wheels against what their geometry says.
#include <gtest/gtest.h>

#include <cmath>

#include "validate/climb.h"

namespace floorproof {
namespace {

TEST(Htetro, RestsOnAllItsWheels) {
  Rig dut("htetro");
  for (int i = 0; i < 500; ++i) dut.Step();
  const Truth& s = dut.truth();
  EXPECT_EQ(s.wheel_contacts, 16);
  EXPECT_NEAR(s.p_WB.z(), 0, 1e-4);
  EXPECT_NEAR(s.wheel_floor_z_m, 0, 1e-4) << "rollers included, the wheels reach the floor";
  EXPECT_LT(s.tilt_rad, 1e-3);
  EXPECT_LT(s.v_WB_W.norm(), 1e-4);
  EXPECT_EQ(s.belly_load_n, 0);
  EXPECT_GT(s.support_margin_m, 0.19);
}

TEST(Htetro, IsAsLargeAsThePaperSays) {
  const RobotSpec robot = ReadRobot(FindRobotFile("htetro", {})).spec;
  EXPECT_NEAR(robot.height_m, 0.10, 1e-9);
  EXPECT_NEAR(robot.inscribed_radius_m, 0.25, 1e-9);
  EXPECT_NEAR(robot.circumscribed_radius_m, std::sqrt(0.125), 1e-9);
  EXPECT_EQ(robot.wheels.size(), 16u);
  EXPECT_NEAR(robot.mass_kg, 11, 1e-9);
  EXPECT_NEAR(robot.clearance_m, 0.025, 1e-9);
  for (const WheelSpec& wheel : robot.wheels) {
    EXPECT_NEAR(wheel.radius_m, 0.030, 1e-12);
    EXPECT_NEAR(std::abs(wheel.roller_angle_rad), kPi / 4, 1e-12);
  }
}

// The twist that wheels of 16 rolling constraints allow: forward, sideways, diagonal, turning and
// all at once, to half a per cent; on a plane and on slabs around a pit elsewhere.
TEST(Htetro, MovesEveryWayAsItsWheelsTurn) {
  // Turning while it moves needs a force across, which soft friction gives with a creep.
  constexpr double kPlainError = 0.005, kCurveError = 0.0075;
  Hazard pit;
  pit.id = "pit";
  const Polygon place = Rectangle({-8, -8}, {-7, -7});
  pit.solids = {{Solid::Kind::kCut, place, {}, -0.1, 0}};
  const double aslant = 0.2 / std::sqrt(2.0);
  for (const auto& hazards : {std::vector<Hazard>{}, std::vector<Hazard>{pit}})
    for (const BodyTwist& twist :
         {BodyTwist{0.2, 0, 0}, BodyTwist{-0.2, 0, 0}, BodyTwist{0, 0.2, 0}, BodyTwist{0, -0.2, 0},
          BodyTwist{aslant, aslant, 0}, BodyTwist{0, 0, 0.5}, BodyTwist{0.2, 0.1, 0.3}}) {
      Rig dut("htetro", {.hazards = hazards});
      const BodyTwist v = dut.Run(twist, 3);
      const double speed = std::hypot(twist.vx_mps, twist.vy_mps);
      const double error = speed > 0 && twist.wz_radps != 0 ? kCurveError : kPlainError;
      EXPECT_NEAR(v.vx_mps, twist.vx_mps, error * speed + 1e-5);
      EXPECT_NEAR(v.vy_mps, twist.vy_mps, error * speed + 1e-5);
      EXPECT_NEAR(v.wz_radps, twist.wz_radps, error * std::abs(twist.wz_radps) + 1e-4);
      EXPECT_LT(std::abs(dut.truth().p_WB.z()), 1e-4) << "no ripple";
    }
}

TEST(Htetro, OneTwoAndFourMillisecondsAndBothIntegratorsAgree) {
  const BodyTwist twist{0.15, 0.1, 0.3};
  Rig fine("htetro", {.physics = {.timestep_s = 0.001}});
  fine.Run(twist, 4);
  for (const PhysicsParams& physics :
       {PhysicsParams{.timestep_s = 0.002}, PhysicsParams{.timestep_s = 0.004},
        PhysicsParams{.timestep_s = 0.004, .integrator = "implicitfast"}}) {
    Rig dut("htetro", {.physics = physics});
    dut.Run(twist, 4);
    EXPECT_NEAR(dut.truth().p_WB.x(), fine.truth().p_WB.x(), 0.005);
    EXPECT_NEAR(dut.truth().p_WB.y(), fine.truth().p_WB.y(), 0.005);
    EXPECT_NEAR(dut.truth().yaw_rad, fine.truth().yaw_rad, 0.01);
  }
}

// A dead wall throws nothing back: what comes back is below a fifth of what came.
TEST(Htetro, ADeadWallThrowsNothingBack) {
  Hazard wall;
  wall.id = "wall";
  wall.solids = {{Solid::Kind::kPrism, Rectangle({0.5, -8}, {8, 8}), {}, 0, 0.15}};
  for (const double timestep_s : {0.002, 0.004}) {
    Rig dut("htetro", {.physics = {.timestep_s = timestep_s}, .hazards = {wall}});
    dut.Command({0.25, 0, 0});
    double back_mps = 0;
    while (dut.truth().t_s < 3) {
      dut.Step();
      back_mps = std::max(back_mps, -dut.truth().V_WB_B.vx_mps);
    }
    EXPECT_LT(back_mps, 0.2 * 0.25) << timestep_s;
    EXPECT_NEAR(dut.truth().p_WB.x(), 0.25, 0.005) << "it stands at the wall";
  }
}

// Rollers roll: pulled along the floor with its wheels held, it resists only along their axes. A
// wheel's own lesson, seen on the robot: with all wheels still it cannot be pushed any way, with
// all wheels free to follow it can.
TEST(Htetro, HeldWheelsHoldItEveryWay) {
  for (const double angle : {0.0, kPi / 4, kPi / 2, 2.5}) {
    Rig dut("htetro");
    dut.Command({});
    mjData* d = dut.data();
    const double push_n = 30;  // of some 86 N that friction gives
    d->xfrc_applied[6 * dut.scene().base_body] = push_n * std::cos(angle);
    d->xfrc_applied[6 * dut.scene().base_body + 1] = push_n * std::sin(angle);
    for (int i = 0; i < 250; ++i) dut.Step();
    EXPECT_LT(dut.truth().p_WB.head<2>().norm(), 0.10) << angle;
    EXPECT_LT(dut.truth().v_WB_W.norm(), 0.10) << angle;
  }
}

// Whether the robot, driven forward (or sideways, left first), comes to stand beyond the strip
// that begins 0.5 m ahead.
bool Crosses(bool sideways, const Hazard& hazard) {
  constexpr double kSpeed_mps = 0.2;
  Rig dut("htetro", {.hazards = {hazard}});
  dut.Command(sideways ? BodyTwist{0, kSpeed_mps, 0} : BodyTwist{kSpeed_mps, 0, 0});
  const auto way = [&] { return sideways ? dut.truth().p_WB.y() : dut.truth().p_WB.x(); };
  while (dut.truth().t_s < 2.5 / kSpeed_mps && way() < 1.4) dut.Step();
  return way() >= 1.4;
}

// The lateral rounding of a Mecanum wheel is its rollers': it climbs far less sideways. Measured
// limits at 0.2 m/s are 24 mm and 5.8 mm.
TEST(Htetro, ClimbsHigherForwardThanSideways) {
  constexpr double kEdge_m = 0.5;
  EXPECT_TRUE(Crosses(false, Ledge(0.020, kEdge_m, false)));
  EXPECT_FALSE(Crosses(false, Ledge(0.030, kEdge_m, false)));
  EXPECT_TRUE(Crosses(true, Ledge(0.004, kEdge_m, true)));
  EXPECT_FALSE(Crosses(true, Ledge(0.008, kEdge_m, true)));
}

// What the FMEA paper saw: a cable cover crossed forward that holds the robot when met sideways.
TEST(Htetro, ACableCoverCrossedForwardHoldsItSideways) {
  const double flank_m = 0.020 / std::tan(38 * kPi / 180), top = 0.05;
  const auto cover = [&](bool sideways) {
    const auto strip = [&](double half) {
      return sideways ? Rectangle({-8, 0.6 - half}, {8, 0.6 + half})
                      : Rectangle({0.6 - half, -8}, {0.6 + half, 8});
    };
    return Prism("cover", strip(top / 2 + flank_m), strip(top / 2), 0.020);
  };
  EXPECT_TRUE(Crosses(false, cover(false)));
  EXPECT_FALSE(Crosses(true, cover(true)));
}

TEST(Htetro, MirroredHazardsGiveMirroredMotion) {
  const auto run = [](double side) {
    Rig dut(
        "htetro",
        {.hazards = {Prism("plank", Rectangle({0.4, std::min(0.0, side)}, {2, std::max(0.0, side)}),
                           {}, 0.012)}});
    dut.Run({0.2, 0, 0}, 5);
    return dut.truth();
  };
  const Truth left = run(8), right = run(-8);
  EXPECT_GT(left.p_WB.x(), 0.8) << "it went up on one side";
  // Where a tyre lies along an edge, the engine finds the contact at one of its ends: half a tyre.
  constexpr double kTyre_m = 0.010;
  EXPECT_NEAR(left.p_WB.x(), right.p_WB.x(), kTyre_m);
  EXPECT_NEAR(left.p_WB.y(), -right.p_WB.y(), kTyre_m);
  EXPECT_NEAR(left.roll_rad, -right.roll_rad, 0.005);
}

}  // namespace
}  // namespace floorproof
