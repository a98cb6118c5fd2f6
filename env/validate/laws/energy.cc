// SPDX-License-Identifier: Apache-2.0
// Where the battery's energy goes, the hotel load aside: E = integral of v(t) i(t) dt of the
// motors' drivers ("audit-sampling", Eq. 5) = kinetic + potential + losses.
//
// Steady driving, all in closed form. n wheels of radius r are asked for u = v / r and meet the
// force F: the friction of sliding casters, and m g sin(theta) uphill. Each motor gives
// T = T_f + b omega + F r / n = k (u - omega) and draws T omega + R (T / K)^2; downhill, where that
// is negative, nothing comes back.
// A step of height h. What the motors took, less heat in windings, brakes, joints, casters' dampers
// and contacts, and less the kinetic energy gained, is m g h; on flat floor, from rest, it is
// m v^2 / 2 with the wheels' and rotors' inertia. The heat is summed from the
// simulation's own forces and speeds; m, v and h are the true ones.
//
// A slope is gravity turned by theta. Tolerances: 1 % of the power for what soft contacts take (the
// floor's creep is below 0.4 % of the speed, see `kinematics`); 4 % of m g h on the step, where the
// implicit integrator takes energy out of the impact at the edge that stands in none of its forces:
// it falls with the time step, which is 1 ms here; 2 % of m v^2 / 2, twice the droop of the speed.
#include <algorithm>

#include "env/validate/law.h"

namespace floorproof {
namespace {

constexpr double kSteadyShare = 0.01, kStepShare = 0.04, kStartShare = 0.02;
constexpr double kLeast_w = 0.003;  // tolerance where nothing is drawn
constexpr double kSpeed_mps = 0.2;
constexpr double kSlope_rad = 5 * kPi / 180;

double MotorsPower(const Rig& rig) { return rig.sample().power_w - rig.robot().hotel_load_w; }

// Friction of casters, which slide on the floor: by their springs' force and their own weight.
double CasterDrag(const mjModel* m) {
  double drag_n = 0;
  for (int j = 0; j < m->njnt; ++j) {
    if (m->jnt_type[j] != mjJNT_SLIDE) continue;
    const int body = m->jnt_bodyid[j], q = m->jnt_qposadr[j];
    const double load_n = m->jnt_stiffness[j] * (m->qpos0[q] - m->qpos_spring[q]) +
                          m->body_mass[body] * kGravity_mps2;
    drag_n += m->geom_friction[3 * m->body_geomadr[body]] * load_n;
  }
  return drag_n;
}

// What the motors draw when they drive at a speed against a force, in closed form.
double SteadyPower(const RobotSpec& robot, const mjModel* m, double force_n) {
  const auto n = static_cast<double>(robot.wheels.size());
  const int dof = m->jnt_dofadr[m->actuator_trnid[0]];
  const double resistance = m->actuator_gainprm[0], constant = m->actuator_gainprm[1];
  const double gain = m->actuator_gainprm[6], damping = m->dof_damping[dof];
  const double radius_m = robot.wheels.front().radius_m;
  const double load_nm = m->dof_frictionloss[dof] + force_n * radius_m / n;
  const double speed_radps = (gain * kSpeed_mps / radius_m - load_nm) / (gain + damping);
  return n * MotorPower(load_nm + damping * speed_radps, speed_radps, resistance, constant);
}

// Sums, step by step, where the energy goes. A step's work is its forces times the mean of the
// speeds before and after it.
class Account {
 public:
  explicit Account(Rig& rig) : rig_(rig), before_(static_cast<std::size_t>(Model()->nv)) {
    kinetic_j_ = Kinetic();
  }
  void Step() {
    const mjModel* m = Model();
    const mjData* d = rig_.data();
    std::copy_n(d->qvel, m->nv, before_.begin());
    rig_.Step();
    double heat_w = 0;
    for (int a = 0; a < m->nu; ++a) heat_w += MotorHeat(a);
    // Constraints: contacts, and the joints' dry friction.
    for (int i = 0; i < m->nv; ++i)
      heat_w -= (d->qfrc_constraint[i] + d->qfrc_damper[i]) * Speed(i);
    left_j_ += (MotorsPower(rig_) - heat_w) * m->opt.timestep;
  }
  // What the battery gave that did not become heat: kinetic and potential energy.
  double left_j() const { return left_j_; }
  double kinetic_j() const { return Kinetic() - kinetic_j_; }

 private:
  const mjModel* Model() const { return rig_.scene().model.get(); }
  double Speed(int dof) const {
    return (before_[static_cast<std::size_t>(dof)] + rig_.data()->qvel[dof]) / 2;
  }
  // Of windings, and of a driver that brakes: what it draws less the work that it does.
  double MotorHeat(int a) const {
    const mjModel* m = Model();
    const mjtNum* gain = m->actuator_gainprm + mjNGAIN * a;
    const int dof = m->jnt_dofadr[m->actuator_trnid[2 * a]];
    const double torque = MotorTorque(m, rig_.data(), a);
    return MotorPower(torque, rig_.data()->qvel[dof], gain[0], gain[1]) - torque * Speed(dof);
  }
  double Kinetic() const {
    const mjModel* m = Model();
    const DataPtr now(mj_copyData(nullptr, m, rig_.data()));
    ForwardEngine(m, now.get());
    mj_energyVel(m, now.get());
    return now->energy[1];
  }

  Rig& rig_;
  std::vector<double> before_;  // speeds before the step
  double kinetic_j_ = 0, left_j_ = 0;
};

class Energy final : public Law {
 public:
  std::string_view statement() const override {
    return "integral of v i dt = kinetic + potential + losses: n (T omega + R (T / K)^2) with "
           "T = T_f + b omega + F r / n, and m g h on a step";
  }
  std::vector<WrongModel> notices() const override { return {kLargerWheels}; }

  void Check(const WrongModel& wrong, std::vector<LawRow>& rows) const override {
    for (const char* robot : {"beluga", "htetro"}) {
      Steady(robot, "flat", 0, wrong, rows);
      Steady(robot, "uphill", kSlope_rad, wrong, rows);
      Steady(robot, "downhill", -kSlope_rad, wrong, rows);
    }
    Start("beluga", wrong, rows);
    Start("htetro", wrong, rows);
    Step("beluga", 0.008, wrong, rows);
    Step("htetro", 0.010, wrong, rows);
  }

 private:
  static void Steady(const std::string& robot, const std::string& name, double slope_rad,
                     const WrongModel& wrong, std::vector<LawRow>& rows) {
    constexpr int kSteps = 500;
    Rig rig(robot, {.wrong = wrong});
    rig.SetGravity({-std::sin(slope_rad), 0, -std::cos(slope_rad)});
    rig.Run({kSpeed_mps, 0, 0}, 2);
    double energy_j = 0;
    const mjModel* m = rig.scene().model.get();
    for (int k = 0; k < kSteps; ++k) {
      rig.Step();
      energy_j += MotorsPower(rig) * m->opt.timestep;
    }
    const double force_n =
        CasterDrag(m) + rig.robot().mass_kg * kGravity_mps2 * std::sin(slope_rad);
    const double expected = SteadyPower(rig.robot(), m, force_n);
    rows.push_back({"energy/" + robot + "/" + name + "/power", expected,
                    energy_j / (kSteps * m->opt.timestep),
                    std::max(kSteadyShare * expected, kLeast_w), "W"});
  }

  // From rest to the speed on flat floor: m v^2 / 2, and the wheels' and rotors' own turning.
  static void Start(const std::string& robot, const WrongModel& wrong, std::vector<LawRow>& rows) {
    constexpr double kRamp_s = 0.5, kDrive_s = 1.5;
    Rig rig(robot, {.wrong = wrong});
    Account account(rig);
    while (rig.sample().t_s < kDrive_s) {
      rig.Command({kSpeed_mps * std::min(1.0, rig.sample().t_s / kRamp_s), 0, 0});
      account.Step();
    }
    const mjModel* m = rig.scene().model.get();
    const int dof = m->jnt_dofadr[m->actuator_trnid[0]], wheel = m->dof_bodyid[dof];
    // About its axle, y; as an inertia whose axes MuJoCo may have permuted: the odd one of three.
    const mjtNum* inertia = m->body_inertia + 3 * wheel;
    const double axle = *std::max_element(inertia, inertia + 3) + m->dof_armature[dof];
    const double radius_m = rig.robot().wheels.front().radius_m;
    const double mass_kg = rig.robot().mass_kg + static_cast<double>(rig.robot().wheels.size()) *
                                                     axle / (radius_m * radius_m);
    const double kinetic_j = mass_kg * kSpeed_mps * kSpeed_mps / 2;
    rows.push_back({"energy/" + robot + "/start/kinetic", kinetic_j, account.left_j(),
                    kStartShare * kinetic_j, "J"});
  }

  // From flat floor onto a raised one, all wheels up.
  static void Step(const std::string& robot, double height_m, const WrongModel& wrong,
                   std::vector<LawRow>& rows) {
    constexpr double kEdge_m = 0.45, kDrive_s = 5.5;
    const Polygon raised = {{kEdge_m, -3}, {9, -3}, {9, 3}, {kEdge_m, 3}};
    RigOptions options{.wrong = wrong};
    options.physics.timestep_s = 0.001;
    options.hazards = {Prism("step", raised, {}, height_m)};
    Rig rig(robot, std::move(options));
    rig.Run({kSpeed_mps, 0, 0}, 0.5);
    Account account(rig);
    const double start_s = rig.sample().t_s;
    while (rig.sample().t_s < start_s + kDrive_s) account.Step();
    const double potential_j = rig.robot().mass_kg * kGravity_mps2 * height_m;
    rows.push_back({"energy/" + robot + "/step/potential", potential_j,
                    account.left_j() - account.kinetic_j(), kStepShare * potential_j, "J"});
  }
};

}  // namespace

FP_DEFINE_PLUGIN(Law, Energy)

}  // namespace floorproof
