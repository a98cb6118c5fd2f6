// SPDX-License-Identifier: Apache-2.0
// Kinematics of blocks on hinges.
#include "env/core/blocks.h"

#include <gtest/gtest.h>

namespace floorproof {
namespace {

// Two unit squares side by side along x, hinged at the upper corner of the edge between them; the
// right one folds up onto the left.
struct TwoSquares {
  std::vector<BlockSpec> blocks = {{"left", Rectangle({0, 0}, {1, 1}), {0.5, 0.5}},
                                   {"right", Rectangle({1, 0}, {2, 1}), {1.5, 0.5}}};
  std::vector<HingeSpec> hinges = {{"hinge", 0, 1, {1, 1}, 1, 0, 0, kPi, 1}};
};

TEST(Blocks, StandAsDrawnWhenNothingIsFolded) {
  const TwoSquares dut;
  const BlockMotions m = MoveBlocks(dut.blocks, dut.hinges, AtRest(std::vector{0.0}));
  EXPECT_NEAR((m.p_RB - Vec2(1, 0.5)).norm(), 0, 1e-12) << "B lies in the middle of both";
  EXPECT_NEAR((m.block[1].X_BK * dut.blocks[1].centre_K - Vec2(0.5, 0)).norm(), 0, 1e-12);
}

TEST(Blocks, HalfATurnStacksThem) {
  const TwoSquares dut;
  const BlockMotions m = MoveBlocks(dut.blocks, dut.hinges, AtRest(std::vector{kPi}));
  EXPECT_NEAR((m.p_RB - Vec2(0.5, 1)).norm(), 0, 1e-12);
  EXPECT_NEAR((m.block[1].X_BK * dut.blocks[1].centre_K - Vec2(0, 0.5)).norm(), 0, 1e-12);
  const Polygon footprint = Footprint(dut.blocks, dut.hinges, std::vector{kPi});
  EXPECT_EQ(footprint.size(), 4u) << "one rectangle, no corner where the squares meet";
  EXPECT_NEAR(SignedArea(footprint), 2, 1e-5);
}

TEST(Blocks, AQuarterTurnLeavesTwoSquaresAtACorner) {
  const TwoSquares dut;
  const BlockMotions m = MoveBlocks(dut.blocks, dut.hinges, AtRest(std::vector{kPi / 2}));
  // The right square's middle goes from (1.5, 0.5) to (1.5, 1.5): the mean to (1, 1).
  EXPECT_NEAR((m.p_RB - Vec2(1, 1)).norm(), 0, 1e-12);
  EXPECT_NEAR(m.block[1].X_BK.yaw_rad, kPi / 2, 1e-12);
}

// Velocities are the derivatives of the places.
TEST(Blocks, MoveAsTheirPlacesChange) {
  const TwoSquares dut;
  const double angle = 0.7, rate = 0.3, dt = 1e-6;
  HingeState state = AtRest(std::vector{angle});
  state.radps[0] = rate;
  const BlockMotions now = MoveBlocks(dut.blocks, dut.hinges, state);
  const BlockMotions then =
      MoveBlocks(dut.blocks, dut.hinges, AtRest(std::vector{angle + rate * dt}));
  EXPECT_NEAR(((then.p_RB - now.p_RB) / dt - now.v_RB).norm(), 0, 1e-5);
  for (const std::size_t k : {0u, 1u})
    for (const Vec2& p_K : dut.blocks[k].outline_K) {
      const Vec2 before = now.block[k].X_BK * p_K, after = then.block[k].X_BK * p_K;
      EXPECT_NEAR(((after - before) / dt - now.block[k].VelocityAt(before)).norm(), 0, 1e-5) << k;
    }
  const Vec2 mean = (now.block[0].VelocityAt(now.block[0].X_BK * dut.blocks[0].centre_K) +
                     now.block[1].VelocityAt(now.block[1].X_BK * dut.blocks[1].centre_K)) /
                    2;
  EXPECT_NEAR(mean.norm(), 0, 1e-12) << "the body frame stays in their middle";
}

}  // namespace
}  // namespace floorproof
