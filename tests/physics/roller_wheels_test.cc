// SPDX-License-Identifier: Apache-2.0
// hTetro on rollers that are bodies, against the twist its wheels' geometry says: so both wheel
// models, each tested against the same, agree.
#include "env/scene/roller_wheels.h"

#include <gtest/gtest.h>

#include <cmath>

#include "validate/climb.h"

namespace floorproof {
namespace {

// Seconds of it cost tens of milliseconds each: a twist a case, short.
void ExpectMoves(const BodyTwist& twist, double error, const RobotChanges& changes = {},
                 const std::vector<Hazard>& hazards = {}) {
  Rig dut("htetro", {.hazards = hazards, .changes = changes, .rollers = true});
  const BodyTwist v = dut.Run(twist, 1.5);
  const double speed = std::hypot(twist.vx_mps, twist.vy_mps);
  EXPECT_LT(std::hypot(v.vx_mps - twist.vx_mps, v.vy_mps - twist.vy_mps), error * speed + 1e-3)
      << twist.vx_mps << " " << twist.vy_mps;
  EXPECT_NEAR(v.wz_radps, twist.wz_radps, error * std::abs(twist.wz_radps) + 0.003);
}

BodyTwist Heading(double angle_deg) {
  constexpr double kSpeed_mps = 0.2;
  const double angle = angle_deg * kPi / 180;
  return {kSpeed_mps * std::cos(angle), kSpeed_mps * std::sin(angle), 0};
}

TEST(RollerWheels, RestOnTheFloorLikeIdealOnes) {
  Rig dut("htetro", {.rollers = true});
  for (int i = 0; i < 100; ++i) dut.Step();
  const Truth& s = dut.truth();
  EXPECT_EQ(s.wheel_contacts, 16) << "rollers count as wheels";
  EXPECT_NEAR(s.p_WB.z(), 0, 1e-4);
  EXPECT_NEAR(s.wheel_floor_z_m, 0, 1e-4);
  EXPECT_LT(s.tilt_rad, 1e-3);
  EXPECT_LT(s.v_WB_W.norm(), 1e-4);
  EXPECT_EQ(s.belly_load_n, 0);
  EXPECT_GT(s.support_margin_m, 0.19);
}

// Measured: 0.2 % forward, 2.9 % sideways, 1.5 % aslant, 2.0 % turning.
TEST(RollerWheels, MoveEveryWayAsTheWheelsTurn) {
  for (const double angle_deg : {0.0, 45.0, 90.0, 200.0, 270.0})
    ExpectMoves(Heading(angle_deg), 0.04);
  ExpectMoves({0, 0, 0.5}, 0.04);
}

TEST(RollerWheels, MoveAlikeOnSlabsAndOnOtherWheels) {
  Hazard pit;
  pit.id = "pit";
  pit.solids = {{Solid::Kind::kCut, Rectangle({-8, -8}, {-7, -7}), {}, -0.1, 0}};
  ExpectMoves(Heading(90), 0.05, {}, {pit});
  ExpectMoves(Heading(90), 0.05, {.wheel_radius_m = 0.04, .roller_radius_m = 0.006});
}

// A shortfall sideways that the geometry predicts: rollers that are not lowest stand aslant, by
// 1 - sin(x) / x in the mean, x = pi / kRollers. Wheels of facets or with slip lose more.
TEST(RollerWheels, LoseSidewaysWhatTheSlantOfTheirRollersTakes) {
  Rig dut("htetro", {.rollers = true});
  const BodyTwist v = dut.Run({0, 0.2, 0}, 3);
  const double x = kPi / kRollers;
  EXPECT_NEAR(v.vy_mps / 0.2, std::sin(x) / x, 0.006);
  EXPECT_NEAR(v.vx_mps, 0, 1e-3);
  EXPECT_LT(std::abs(dut.truth().p_WB.z()), 5e-4) << "ripple";
}

TEST(RollerWheels, ADeadWallThrowsNothingBack) {
  Rig dut("htetro",
          {.hazards = {Prism("wall", Rectangle({0.35, -8}, {8, 8}), {}, 0.15)}, .rollers = true});
  dut.Command({0.25, 0, 0});
  double back_mps = 0;
  while (dut.truth().t_s < 2) {
    dut.Step();
    back_mps = std::max(back_mps, -dut.truth().V_WB_B.vx_mps);
  }
  EXPECT_LT(back_mps, 0.2 * 0.25);
  EXPECT_NEAR(dut.truth().p_WB.x(), 0.10, 0.005) << "it stands at the wall";
}

// Whether all its wheels come to stand on a ledge of this height.
bool StandsOnTop(bool sideways, double height_m) {
  constexpr double kSpeed_mps = 0.2, kEdge_m = 0.35, kUp_m = 0.7;
  Rig dut("htetro", {.hazards = {Ledge(height_m, kEdge_m, sideways)}, .rollers = true});
  dut.Command(sideways ? BodyTwist{0, kSpeed_mps, 0} : BodyTwist{kSpeed_mps, 0, 0});
  const auto way = [&] { return sideways ? dut.truth().p_WB.y() : dut.truth().p_WB.x(); };
  while (dut.truth().t_s < 6 && way() < kUp_m) dut.Step();
  return way() >= kUp_m;
}

// Forward with the wheel's radius, sideways with the rollers', as ideal wheels do: measured limits
// at 0.2 m/s are in docs/physics.md.
TEST(RollerWheels, ClimbHigherForwardThanSideways) {
  EXPECT_TRUE(StandsOnTop(false, 0.018));
  EXPECT_TRUE(StandsOnTop(true, 0.0035));
  EXPECT_FALSE(StandsOnTop(true, 0.009));
}

}  // namespace
}  // namespace floorproof
