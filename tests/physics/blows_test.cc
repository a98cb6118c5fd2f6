// SPDX-License-Identifier: Apache-2.0
// The momentum that a robot loses in a blow is the sum of the reported contact forces times time,
// over all parts of a step that is divided because a tyre meets an edge.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "validate/cart.h"
#include "validate/climb.h"

namespace floorproof {
namespace {

// A cart that rolls freely on a floor without friction, so that only what it meets pushes it along.
class Blow {
 public:
  Blow(const Cart& cart, std::vector<Hazard> hazards, double speed_mps)
      : rig_(MakeCart(cart), Options(std::move(hazards))) {
    Coast(rig_, cart, speed_mps);
    before_ns_ = Momentum();
  }
  void Run(double t_s) {
    const double step_s = rig_.sim().model()->opt.timestep;
    const Truth& now = rig_.truth();
    while (now.t_s < t_s) {
      rig_.Step();
      parts_ = std::max(parts_, rig_.sim().parts());
      for (int i = 0; i < now.num_touches; ++i) {
        const Touch& touch = now.touches[static_cast<std::size_t>(i)];
        pushed_ns_[touch.hazard] += touch.normal.force_W_n.x() * step_s;
        rubbed_ns_[touch.hazard] += touch.friction.force_W_n.x() * step_s;
      }
      for (int i = 0; i < now.num_contacts; ++i) {
        const ObstacleContact& contact = now.contacts[static_cast<std::size_t>(i)];
        if (contact.hazard < 0) continue;
        met_ns_[contact.hazard] += contact.impulse_ns * contact.normal_W.x();
        closing_mps_[contact.hazard] = std::max(closing_mps_[contact.hazard], contact.closing_mps);
        most_contacts_ = std::max(most_contacts_, now.num_contacts);
      }
    }
  }

  double before_ns() const { return before_ns_; }
  double lost_ns() { return before_ns_ - Momentum(); }
  int parts() const { return parts_; }
  int most_contacts() const { return most_contacts_; }
  // By hazard, along x.
  double pushed_ns(int hazard) const { return pushed_ns_[hazard]; }
  double rubbed_ns(int hazard) const { return rubbed_ns_[hazard]; }
  double met_ns(int hazard) const { return met_ns_[hazard]; }
  double closing_mps(int hazard) const { return closing_mps_[hazard]; }

 private:
  static RigOptions Options(std::vector<Hazard> hazards) {
    RigOptions options{.friction = 1e-4};
    for (Hazard& hazard : hazards) hazard.material.friction = 0.8;
    options.hazards = std::move(hazards);
    return options;
  }
  double Momentum() {
    const mjModel* m = rig_.sim().model();
    const DataPtr copy = MakeData(m);
    mj_copyData(copy.get(), m, rig_.data());
    ForwardEngine(m, copy.get());
    mj_subtreeVel(m, copy.get());
    const int base = rig_.scene().base_body;
    return m->body_subtreemass[base] * copy->subtree_linvel[3 * base];
  }

  Rig rig_;
  double before_ns_ = 0;
  int parts_ = 1, most_contacts_ = 0;
  double pushed_ns_[2] = {}, rubbed_ns_[2] = {}, met_ns_[2] = {}, closing_mps_[2] = {};
};

struct Edge {
  double height_m = 0, speed_mps = 0;
};

class Blows : public ::testing::TestWithParam<Edge> {};
INSTANTIATE_TEST_SUITE_P(Edges, Blows,
                         ::testing::Values(Edge{0.01, 0.5}, Edge{0.01, 1}, Edge{0.03, 0.5},
                                           Edge{0.03, 1}, Edge{0.06, 0.5}, Edge{0.06, 1}),
                         [](const auto& edge) {
                           return std::to_string(std::lround(1000 * edge.param.height_m)) + "mm_" +
                                  std::to_string(std::lround(1000 * edge.param.speed_mps)) + "mmps";
                         });

TEST_P(Blows, AreTheMomentumThatIsLost) {
  const auto [height_m, speed_mps] = GetParam();
  const Cart cart{.tyre_npmm = 200};
  Rig truth(MakeCart(cart));
  Blow dut(cart, {Ledge(height_m, PlaceEdge(truth, false).edge_m, false)}, speed_mps);
  dut.Run(0.2);
  EXPECT_GT(dut.parts(), 1);
  EXPECT_NEAR(-dut.pushed_ns(0) - dut.rubbed_ns(0), dut.lost_ns(), 0.005 * dut.before_ns())
      << "of " << dut.before_ns();
  if (height_m > cart.wheel_radius_m) return;  // a face: it rubs upwards
  EXPECT_GT(std::abs(dut.rubbed_ns(0)), 0.005 * dut.before_ns()) << "friction counts too";
}

// A nose meets a wall with its corners as the wheels meet an edge: each contact is followed through
// the parts of a step.
TEST(BlowsOfTwo, AreToldApart) {
  constexpr double kSpeed_mps = 0.5;
  const Cart cart{.nose_m = 0.3, .clearance_m = 0.05, .tyre_npmm = 200};
  Rig truth(MakeCart(cart));
  const double edge_m = PlaceEdge(truth, false).edge_m;
  const double gap_m = edge_m - (cart.axle_x_m + cart.wheel_radius_m);
  Hazard wall = Ledge(0.3, cart.nose_m + gap_m, false);
  Hazard edge = Prism("edge", Rectangle({edge_m, -8}, {cart.nose_m, 8}), {}, 0.045);
  Blow dut(cart, {std::move(edge), std::move(wall)}, kSpeed_mps);
  dut.Run(0.2);
  EXPECT_GT(dut.parts(), 1);
  EXPECT_GE(dut.most_contacts(), 4);
  EXPECT_LT(dut.met_ns(1), -0.05 * dut.before_ns()) << "the wall is met";
  EXPECT_NEAR(dut.met_ns(1), dut.pushed_ns(1), 1e-3 * dut.before_ns()) << "by all its contacts";
  EXPECT_NEAR(dut.closing_mps(1), kSpeed_mps, 0.02);
  EXPECT_NEAR(-dut.pushed_ns(0) - dut.rubbed_ns(0) - dut.pushed_ns(1) - dut.rubbed_ns(1),
              dut.lost_ns(), 0.005 * dut.before_ns());
}

}  // namespace
}  // namespace floorproof
