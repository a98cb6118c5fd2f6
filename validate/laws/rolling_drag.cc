// SPDX-License-Identifier: Apache-2.0
// What a carpet takes from a wheel that rolls on it, as a share c of its load, in two ways.
//
// `coast`: a cart whose motors give nothing and whose bearings rub with T_f each, from the speed v
// to rest. Its wheels and rotors turn with it, I each: m' = m + n I / r^2, and
// s = m' v^2 / (2 (c m g + n T_f / r)) - v h / 2, h the time step (as in the law `stopping`).
// `force`: a robot that drives steadily. All torques of its motors, less what its n bearings take,
// T_f + b omega each, over the wheels' radius: c m g beside what its casters rub on level floor (of
// casters that slide, c is so much more friction). How the weight lies on sixteen wheels does not
// matter to the sum; to the motors' heat it does.
//
// Tolerances: 1 %, soft contacts creep; BELUGA's force 2 %, for it nods on its springs as it
// drives.
#include <fmt/format.h>

#include <algorithm>

#include "env/scene/driving_power.h"
#include "validate/cart.h"
#include "validate/law.h"
#include "validate/made_hazard.h"
#include "validate/steady_drive.h"

namespace floorproof {
namespace {

constexpr double kShare = 0.01, kNods = 0.02;

class RollingDrag final : public Law {
 public:
  std::string_view statement() const override {
    return "on a carpet of rolling drag c: coasting m' v^2 / (2 (c m g + n T_f / r)), driving "
           "against F = c m g";
  }
  std::vector<WrongModel> notices() const override { return {{.drag_factor = 1.3}}; }

  void Check(const WrongModel& wrong, std::vector<LawRow>& rows) const override {
    for (const double drag : {0.01, 0.04}) {
      for (const double v_mps : {0.3, 0.6}) Coast(drag, v_mps, wrong, rows);
      Force("beluga", drag, kNods, wrong, rows);
      Force("htetro", drag, kShare, wrong, rows);
    }
  }

 private:
  static constexpr double kPile_m = 0.006;

  // All that the rig drives on, and beyond.
  static RigOptions OnCarpet(double drag, const WrongModel& wrong) {
    RigOptions options{.wrong = wrong};
    options.hazards = {
        MakeHazard("carpet", fmt::format("height_m: {}, bevel: 0, rolling_drag: {}", kPile_m, drag),
                   Rectangle({-9, -9}, {9, 9}))};
    return options;
  }

  static void Coast(double drag, double v_mps, const WrongModel& wrong, std::vector<LawRow>& rows) {
    const Cart cart;
    Rig rig(MakeCart(cart), OnCarpet(drag, wrong));
    const double r_m = cart.wheel_radius_m;
    mjModel* m = rig.sim().model();
    const int wheel = m->jnt_bodyid[m->actuator_trnid[0]];
    const int axle = m->jnt_dofadr[m->actuator_trnid[0]];
    const mjtNum* about = m->body_inertia + 3 * wheel;
    const double inertia = *std::max_element(about, about + 3) + m->dof_armature[axle];
    const double mass_kg = rig.robot().mass_kg + 4 * inertia / (r_m * r_m);
    const double force_n = drag * Weight(rig.robot()) + 4 * m->dof_frictionloss[axle] / r_m;
    const double h_s = m->opt.timestep;
    const double expected_m = mass_kg * v_mps * v_mps / (2 * force_n) - v_mps * h_s / 2;

    for (int a = 0; a < m->nu; ++a) {  // motors that give nothing
      m->actuator_gainprm[mjNGAIN * a] = 0;
      std::fill_n(m->actuator_biasprm + mjNBIAS * a, mjNBIAS, 0.0);
    }
    rig.SetBase(rig.truth().p_WB, Eigen::Quaterniond::Identity(), {v_mps, 0, 0});
    for (int a = 0; a < m->nu; ++a)
      rig.data()->qvel[m->jnt_dofadr[m->actuator_trnid[2 * a]]] = v_mps / r_m;
    double last_m = 0, way_m = 0;
    const double from_m = rig.truth().p_WB.x();
    do {
      rig.Step();
      last_m = way_m;
      way_m = rig.truth().p_WB.x() - from_m;
    } while (way_m - last_m > 0.001 * h_s && rig.truth().t_s < 60);
    rows.push_back({fmt::format("rolling_drag/cart/c{}/v{}/coast", drag, v_mps), expected_m, way_m,
                    kShare * expected_m, "m"});
  }

  static void Force(const char* name, double drag, double share, const WrongModel& wrong,
                    std::vector<LawRow>& rows) {
    constexpr double kSpeed_mps = 0.2, kSteady_s = 2, kDrive_s = 2;
    Rig rig(name, OnCarpet(drag, wrong));
    rig.Run({kSpeed_mps, 0, 0}, kSteady_s);
    const mjModel* m = rig.sim().model();
    const double radius_m = rig.robot().wheels.front().radius_m, start_s = rig.truth().t_s;
    double force_n = 0;
    int n = 0;
    for (; rig.truth().t_s < start_s + kDrive_s; ++n) {
      rig.Step();
      for (int a = 0; a < static_cast<int>(rig.robot().wheels.size()); ++a) {
        const int dof = m->jnt_dofadr[m->actuator_trnid[2 * a]];
        const double bearing_nm =
            m->dof_frictionloss[dof] + m->dof_damping[dof] * rig.data()->qvel[dof];
        force_n += (MotorTorque(m, rig.data(), a) - bearing_nm) / radius_m;
      }
    }
    const double expected_n =
        drag * Weight(rig.robot()) + CasterDrag(rig.scene().model.get(), rig.robot(), kSpeed_mps);
    rows.push_back({fmt::format("rolling_drag/{}/c{}/force", name, drag), expected_n, force_n / n,
                    share * expected_n, "N"});
  }
};

}  // namespace

FP_DEFINE_PLUGIN(Law, RollingDrag)

}  // namespace floorproof
