// SPDX-License-Identifier: Apache-2.0
// BELUGA on flat floor against what its geometry says.
#include <gtest/gtest.h>

#include <cmath>

#include "run/scenario/scenario.h"
#include "tests/run/scenario_text.h"
#include "validate/rig.h"

namespace floorproof {
namespace {

TEST(Beluga, RestsOnItsWheelsAndCasters) {
  Rig dut("beluga");
  for (int i = 0; i < 500; ++i) dut.Step();
  const Truth& s = dut.truth();
  EXPECT_NEAR(s.p_WB.z(), 0, 0.0005);
  EXPECT_LT(s.tilt_rad, 0.01);
  EXPECT_NEAR(s.V_WB_B.vx_mps, 0, 1e-4);
  EXPECT_EQ(s.belly_load_n, 0);
  EXPECT_GT(s.support_margin_m, 0.05);
  EXPECT_EQ(s.near_hazard, -1);
}

// v = omega r, straight and in bends, forward and back: slip and motor droop below 2 %.
TEST(Beluga, RollsAsItsWheelsTurn) {
  constexpr double kSlip = 0.02;
  for (const BodyTwist& twist : {BodyTwist{0.25, 0, 0}, BodyTwist{-0.2, 0, 0},
                                 BodyTwist{0.2, 0, 0.5}, BodyTwist{0.1, 0, -0.3}}) {
    Rig dut("beluga");
    const BodyTwist v = dut.Run(twist, 2);
    EXPECT_NEAR(v.vx_mps, twist.vx_mps, kSlip * std::abs(twist.vx_mps));
    EXPECT_NEAR(v.vy_mps, 0, 0.005);
    EXPECT_NEAR(v.wz_radps, twist.wz_radps, 0.03 * std::abs(twist.wz_radps) + 1e-4);
  }
}

TEST(Beluga, MirroredCommandsGiveMirroredMotion) {
  Rig left("beluga"), right("beluga");
  left.Run({0.2, 0, 0.6}, 3);
  right.Run({0.2, 0, -0.6}, 3);
  const Truth &l = left.truth(), &r = right.truth();
  constexpr double kSolver_m = 0.002;  // contacts are solved in an order that a mirror changes
  EXPECT_NEAR(l.p_WB.x(), r.p_WB.x(), kSolver_m);
  EXPECT_NEAR(l.p_WB.y(), -r.p_WB.y(), kSolver_m);
  EXPECT_NEAR(l.yaw_rad, -r.yaw_rad, 0.005);
}

// The answer does not hang on the step or the integrator.
TEST(Beluga, OneTwoAndFourMillisecondsAgree) {
  Rig fine("beluga", {.physics = {.timestep_s = 0.001}});
  fine.Run({0.2, 0, 0.4}, 4);
  for (const PhysicsParams& physics :
       {PhysicsParams{.timestep_s = 0.002}, PhysicsParams{.timestep_s = 0.004},
        PhysicsParams{.timestep_s = 0.004, .integrator = "implicitfast"}}) {
    Rig dut("beluga", {.physics = physics});
    dut.Run({0.2, 0, 0.4}, 4);
    EXPECT_NEAR(dut.truth().p_WB.x(), fine.truth().p_WB.x(), 0.01);
    EXPECT_NEAR(dut.truth().p_WB.y(), fine.truth().p_WB.y(), 0.01);
    EXPECT_NEAR(dut.truth().yaw_rad, fine.truth().yaw_rad, 0.02);
  }
}

class Seams : public ScenarioTest {};

// A pit elsewhere cuts the floor into slabs; rolling over their borders is not felt.
TEST_F(Seams, AreNotFelt) {
  Save("plan.csv", "x_m,y_m\n1.5,1.5\n7.5,1.5\n7.5,3.5\n1.5,3.5\n");
  const std::string pit =
      "{id: pit, type: step, height_m: -0.1, polygon_m: [[4, 2.2], [4.6, 2.2], [4.6, 2.8], [4, "
      "2.8]]}";
  Scenario with = Read(RoomScenario(pit, "start: {x_m: 1.5, y_m: 1.5}\n"));
  const Scene scene =
      BuildScene(with.world.site.map, with.world.robot, with.world.physics, with.world.start);
  ASSERT_GT(scene.num_floor_geoms, 3) << "there are seams to cross";
  const EpisodeRecord dut = Drive(std::move(with));
  EXPECT_EQ(dut.outcome, Outcome::kSuccess);
  double highest = 0, lowest = 0;
  for (std::size_t i = 50; i < dut.trace.size(); ++i) {
    highest = std::max<double>(highest, dut.trace[i].z_m);
    lowest = std::min<double>(lowest, dut.trace[i].z_m);
  }
  EXPECT_LT(highest, 0.0005);
  EXPECT_GT(lowest, -0.0005);
}

}  // namespace
}  // namespace floorproof
