// SPDX-License-Identifier: Apache-2.0
// What a blow at an edge takes from a robot's momentum is what the contacts are said to have given:
// force times time, over all parts of the steps in which a tyre meets the edge.
#include <gtest/gtest.h>

#include "validate/cart.h"
#include "validate/climb.h"

namespace floorproof {
namespace {

struct Blow {
  double height_m = 0, speed_mps = 0;
};

class Blows : public ::testing::TestWithParam<Blow> {};
INSTANTIATE_TEST_SUITE_P(Edges, Blows,
                         ::testing::Values(Blow{0.01, 0.5}, Blow{0.01, 1}, Blow{0.03, 0.5},
                                           Blow{0.03, 1}, Blow{0.06, 0.5}, Blow{0.06, 1}),
                         [](const auto& blow) {
                           return std::to_string(std::lround(1000 * blow.param.height_m)) + "mm_" +
                                  std::to_string(std::lround(1000 * blow.param.speed_mps)) + "mmps";
                         });

// Free wheels on a slippery floor: beside the edge nothing pushes it along.
TEST_P(Blows, AreTheMomentumThatIsLost) {
  const auto [height_m, speed_mps] = GetParam();
  const Cart cart{.tyre_npmm = 200};
  Rig truth(MakeCart(cart));
  RigOptions options{.friction = 0.001};
  options.hazards.push_back(Ledge(height_m, PlaceEdge(truth, false).edge_m, false));
  Rig rig(MakeCart(cart), std::move(options));
  Coast(rig, cart, speed_mps);
  const double step_s = rig.sim().model()->opt.timestep;
  double touched_ns = 0;
  while (rig.truth().t_s < 0.2) {
    rig.Step();
    for (int i = 0; i < rig.truth().num_touches; ++i) {
      const Touch& touch = rig.truth().touches[static_cast<std::size_t>(i)];
      touched_ns += (touch.normal.force_W_n + touch.friction.force_W_n).x() * step_s;
    }
  }
  const double before_ns = rig.robot().mass_kg * speed_mps;
  const double lost_ns = before_ns - rig.robot().mass_kg * rig.truth().v_WB_W.x();
  EXPECT_NEAR(-touched_ns, lost_ns, 0.01 * before_ns) << "of " << before_ns;
}

}  // namespace
}  // namespace floorproof
