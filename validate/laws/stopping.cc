// SPDX-License-Identifier: Apache-2.0
// Stopping distance with locked wheels, v^2 / (2 a) - v h / 2. The second term is the time step's,
// h: the integrator moves by the new velocity, so of n = v / (a h) steps step k goes (v - k a h) h,
// which sums to v^2 / (2 a) - v h / 2, half a step at the first speed short of the continuous way.
//
// Plain wheels: a = mu g; where casters carry a load F of the weight W and rub with mu_c (BELUGA's
// springs: F is the same however it pitches), a = g (mu (W - F) + mu_c F) / W.
// Mecanum wheels rub along their rollers' axes alone, half of the wheels along e1 = 45 deg left of
// forward, half along e2 = 45 deg right of it, each with mu of its load against the way it slides.
// Two such forces of mu W / 2 at a right angle stop it forward and sideways with a = mu g cos 45
// deg. Along a roller's axis one half rubs and the other rolls; how the weight lies on the two is
// not determined by statics, so there is no closed form to compare with (docs/validation.md).
//
// Tolerance 1 % and 0.3 mm: friction softens as the speed falls below mu g times the 10 ms in which
// it stops a slip, and over the last tenths of a millimetre the robot creeps. BELUGA 3 %: as it
// nods, its casters' dampers and the ends of their travel carry more or less than the springs.
#include <fmt/format.h>

#include "validate/cart.h"
#include "validate/law.h"

namespace floorproof {
namespace {

constexpr double kShare = 0.01, kNodding = 0.03, kCrept_m = 0.0003;

// The way that the wheels' axles slide from this speed, in this direction, until they stand. The
// body's origin lies below them: as locked wheels let the body nod, it swings.
double Slide(Rig& rig, double axle_m, double v_mps, double way_rad) {
  rig.Brake();
  const Vec3 along_W(std::cos(way_rad), std::sin(way_rad), 0);
  rig.SetBase({0, 0, rig.truth().p_WB.z()}, Eigen::Quaterniond::Identity(), v_mps * along_W);
  constexpr double kStands_mps = 0.003, kMax_s = 10;
  double way_m = 0, last_m = 0;
  do {
    rig.Step();
    const Truth& sample = rig.truth();
    last_m = way_m;
    way_m = (sample.p_WB + axle_m * Vec3(std::sin(sample.pitch_rad), 0, 0)).dot(along_W);
  } while (way_m - last_m > kStands_mps * rig.sim().model()->opt.timestep &&
           rig.truth().t_s < kMax_s);
  return way_m;
}

// The share of BELUGA's weight on its casters, springs at the middle of their travel.
double CasterShare(const Rig& truth) {
  const mjModel* m = truth.scene().model.get();
  double load_n = 0;
  for (int j = 0; j < m->njnt; ++j)
    if (m->jnt_type[j] == mjJNT_SLIDE)
      load_n -= m->jnt_stiffness[j] * m->qpos_spring[m->jnt_qposadr[j]];
  return load_n / (truth.robot().mass_kg * kGravity_mps2);
}
double CasterFriction(const Rig& truth) {
  const mjModel* m = truth.scene().model.get();
  return m->geom_friction[3 * mj_name2id(m, mjOBJ_GEOM, "caster_front")];
}

class Stopping final : public Law {
 public:
  std::string_view statement() const override {
    return "wheels locked: s = v^2 / (2 a) - v h / 2, h the time step; a = mu g, on Mecanum "
           "wheels, "
           "forward and sideways, mu g cos 45 deg";
  }
  std::vector<WrongModel> notices() const override { return {kMoreFriction}; }

  void Check(const WrongModel& wrong, std::vector<LawRow>& rows) const override {
    const Rig truth("beluga");
    const double light = CasterShare(truth);
    for (const double mu : {0.2, 0.4})
      for (const double v_mps : {0.5, 1.0}) {
        const RigOptions options{.friction = mu, .wrong = wrong};
        const auto row = [&](const char* name, Rig& rig, double axle_m, double way_rad,
                             double a_mps2, double share = kShare) {
          const double step_s = options.physics.timestep_s;
          const double s_m = v_mps * v_mps / (2 * a_mps2) - v_mps * step_s / 2;
          rows.push_back({fmt::format("stopping/{}/mu{}/v{}", name, mu, v_mps), s_m,
                          Slide(rig, axle_m, v_mps, way_rad), share * s_m + kCrept_m, "m"});
        };
        Rig cart(MakeCart({}), options);
        row("cart", cart, Cart{}.wheel_radius_m, 0, mu * kGravity_mps2);
        Rig beluga("beluga", options);
        const double friction = mu * (1 - light) + CasterFriction(truth) * light;
        row("beluga", beluga, beluga.robot().wheels.front().radius_m, 0, kGravity_mps2 * friction,
            kNodding);
        for (const bool sideways : {false, true}) {
          Rig htetro("htetro", options);
          row(sideways ? "htetro/sideways" : "htetro/forward", htetro,
              htetro.robot().wheels.front().radius_m, sideways ? kPi / 2 : 0,
              mu * kGravity_mps2 * std::cos(kPi / 4));
        }
      }
  }
};

}  // namespace

FP_DEFINE_PLUGIN(Law, Stopping)

}  // namespace floorproof
