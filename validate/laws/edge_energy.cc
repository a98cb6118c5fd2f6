// SPDX-License-Identifier: Apache-2.0
// A cart that coasts over an edge gains no energy there, up or down: at no moment are its kinetic
// and potential energy together greater than they and its tyres' were before.
//
// Measured: the greatest excess over the energy at the start, as a share of it; 0.2 % is allowed,
// for the integrator. Friction and larger wheels cannot show in it; the wrong model is gravity x
// 1.3, under which a falling cart gains energy.
#include <fmt/format.h>

#include <algorithm>

#include "validate/cart.h"
#include "validate/climb.h"
#include "validate/law.h"

namespace floorproof {
namespace {

constexpr double kShare = 0.002, kHeight_m = 0.01;

class EdgeEnergy final : public Law {
 public:
  std::string_view statement() const override {
    return "a cart that coasts over an edge never has more energy than before it";
  }
  std::vector<WrongModel> notices() const override { return {{.gravity_factor = 1.3}}; }

  void Check(const WrongModel& wrong, std::vector<LawRow>& rows) const override {
    for (const double tyre_npmm : {50.0, 200.0, 1000.0})
      for (const double speed_mps : {0.5, 1.0})
        for (const bool up : {true, false})
          rows.push_back({fmt::format("edge_energy/cart/{}npmm/{}mps/{}", tyre_npmm, speed_mps,
                                      up ? "up" : "down"),
                          0, Excess(tyre_npmm, speed_mps, up, wrong), kShare, "share"});
  }

 private:
  static double Excess(double tyre_npmm, double speed_mps, bool up, const WrongModel& wrong) {
    constexpr double kDrive_s = 1;
    const Cart cart{.tyre_npmm = tyre_npmm};
    Rig truth(MakeCart(cart));
    const double edge_m = PlaceEdge(truth, false).edge_m;
    RigOptions options{.wrong = wrong};
    options.hazards.push_back(up ? Ledge(kHeight_m, edge_m, false)
                                 : Prism("ledge", Rectangle({-8, -8}, {edge_m, 8}), {}, kHeight_m));
    Rig rig(MakeCart(cart), std::move(options));
    Coast(rig, cart, speed_mps, up ? 0 : kHeight_m);
    const mjModel* m = rig.sim().model();
    const DataPtr copy = MakeData(m);
    const mjtNum* com = copy->subtree_com + 3 * rig.scene().base_body;
    const auto kinetic_j = [&] {
      mj_copyData(copy.get(), m, rig.data());
      ForwardEngine(m, copy.get());
      mj_energyVel(m, copy.get());
      return copy->energy[1];
    };
    const auto potential_j = [&] { return rig.robot().mass_kg * kGravity_mps2 * com[2]; };
    double tyres_j = 0;
    for (const Foot& foot : rig.feet()) tyres_j += foot.load_n * foot.sink_m() / 2;
    const double kinetic0_j = kinetic_j(), before_j = kinetic0_j + potential_j() + tyres_j;
    double most_j = before_j;
    while (rig.truth().t_s < kDrive_s) {
      rig.Step();
      const double now_j = kinetic_j();
      most_j = std::max(most_j, now_j + potential_j());
    }
    return (most_j - before_j) / kinetic0_j;
  }
};

}  // namespace

FP_DEFINE_PLUGIN(Law, EdgeEnergy)

}  // namespace floorproof
