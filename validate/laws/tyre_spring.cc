// SPDX-License-Identifier: Apache-2.0
// A body of mass m on four tyres of stiffness K and damping B each stands m g / (4 K) lower for
// each m g more that it weighs, and pushed down it swings up and down at
//
//   w = sqrt(4 K / m - (2 B / m)^2)
//
// m is all that moves with the body: its wheels do, and so do their treads (wheel_pairs.h), d / ((1
// - d) A) each. The cart's own weight is doubled; its radius is that under its own.
//
// Tolerances: 1 % of the sink and of the frequency, for the implicit integrator, which slows a
// swing: the step is 0.2 ms here.
#include <fmt/format.h>

#include "env/scene/wheel_pairs.h"
#include "validate/cart.h"
#include "validate/law.h"

namespace floorproof {
namespace {

constexpr double kShare = 0.01, kFine_s = 0.0002, kRest_s = 1;

class TyreSpring final : public Law {
 public:
  std::string_view statement() const override {
    return "a body on four tyres of stiffness K sinks by F / (4 K) under a force F and swings at "
           "sqrt(4 K / m - (2 B / m)^2), m with the treads";
  }
  std::vector<WrongModel> notices() const override { return {{.tyre_factor = 1.3}}; }

  void Check(const WrongModel& wrong, std::vector<LawRow>& rows) const override {
    for (const double stiffness_npmm : {50.0, 200.0, 1000.0}) Sink(stiffness_npmm, wrong, rows);
    for (const double stiffness_npmm : {20.0, 50.0}) Swing(stiffness_npmm, wrong, rows);
  }

 private:
  static Rig OnTyres(double stiffness_npmm, double damping_ratio, const WrongModel& wrong) {
    RigOptions options{.wrong = wrong};
    options.physics.timestep_s = kFine_s;
    return Rig(MakeCart({.tyre_npmm = stiffness_npmm, .tyre_damping_ratio = damping_ratio}),
               std::move(options));
  }

  static void Sink(double stiffness_npmm, const WrongModel& wrong, std::vector<LawRow>& rows) {
    Rig rig = OnTyres(stiffness_npmm, 0.3, wrong);
    const double before_m = rig.truth().p_WB.z();
    rig.SetGravity({0, 0, -2});
    while (rig.truth().t_s < kRest_s) rig.Step();
    const double sink_m = rig.robot().mass_kg * kGravity_mps2 / (4000 * stiffness_npmm);
    rows.push_back({fmt::format("tyre/sink/{}npmm", stiffness_npmm), 1000 * sink_m,
                    1000 * (before_m - rig.truth().p_WB.z()), 1000 * kShare * sink_m, "mm"});
  }

  // Over four times that it goes down past where it rests.
  static void Swing(double stiffness_npmm, const WrongModel& wrong, std::vector<LawRow>& rows) {
    constexpr int kPeriods = 4;
    Rig rig = OnTyres(stiffness_npmm, 0.01, wrong);
    const double rest_m = rig.truth().p_WB.z();
    rig.SetBase(rig.truth().p_WB, Eigen::Quaterniond::Identity(), {0, 0, -0.02});
    double first_s = 0, last_s = 0, z_m = rest_m - 1;
    int downward = 0;
    while (downward <= kPeriods && rig.truth().t_s < kRest_s) {
      rig.Step();
      const double now_m = rig.truth().p_WB.z();
      if (z_m > rest_m && now_m <= rest_m) {
        const double at_s = rig.truth().t_s - kFine_s * (rest_m - now_m) / (z_m - now_m);
        (downward == 0 ? first_s : last_s) = at_s;
        ++downward;
      }
      z_m = now_m;
    }
    const Foot& foot = rig.feet().front();
    const Tyre& tyre = foot.tyre;
    const double tread_kg = kTyreImpedance / (1 - kTyreImpedance) / foot.inverse_mass_pkg;
    const double m = rig.robot().mass_kg + 4 * tread_kg;
    const double damping = 2 * tyre.damping_nspm / m;
    const double expected = std::sqrt(4 * tyre.stiffness_npm / m - damping * damping);
    rows.push_back({fmt::format("tyre/swing/{}npmm", stiffness_npmm), expected,
                    2 * kPi * kPeriods / (last_s - first_s), kShare * expected, "rad/s"});
  }
};

}  // namespace

FP_DEFINE_PLUGIN(Law, TyreSpring)

}  // namespace floorproof
