// SPDX-License-Identifier: Apache-2.0
// Where the battery's energy goes, the hotel load aside: E = integral of v(t) i(t) dt of the
// motors' drivers ("audit-sampling", Eq. 5) = kinetic + potential + losses.
//
// Steady driving, all in closed form. n wheels of radius r are asked for u = v / r and meet the
// force F: the friction of sliding casters, and m g sin(theta) uphill. Each motor gives
// T = T_f + b omega + F r / n = k (u - omega) and draws T omega + R (T / K)^2; downhill, where that
// is negative, nothing comes back. `power` is what the battery gives; where it gives nothing there
// is no such row, as 0 is right whatever the motors are. `losses` is the heat, and what it must be:
// power - m g omega r sin(theta), downhill the power and the weight's work.
// A step of height h. What the battery gave, less the heat, and less the kinetic energy gained, is
// m g h; on flat floor, from rest, it is m v^2 / 2 with the wheels' and rotors' inertia.
//
// The heat in windings and brakes does not come from the power that the simulation computes: with
// the shaft's torque T a current i = T / K heats the windings by R i^2, K and R the true model's,
// and a driver that brakes burns what it would return. The heat in joints, casters' dampers and
// contacts is summed from the simulation's forces and speeds. m, v and h are the true ones.
//
// A slope is gravity turned by theta. Tolerances: 1 % of the power for what soft contacts take (the
// floor's creep is below 0.4 % of the speed, see `kinematics`); 4 % of m g h on the step, where the
// implicit integrator takes energy out of the impact at the edge that stands in none of its forces:
// it falls with the time step, which is 1 ms here; 2 % of m v^2 / 2, twice the droop of the speed.
#include <algorithm>

#include "validate/law.h"
#include "validate/steady_drive.h"

namespace floorproof {
namespace {

constexpr double kSteadyShare = 0.01, kStepShare = 0.04, kStartShare = 0.02;
constexpr double kFine_s = 0.001;  // time step where speeds change
constexpr double kSpeed_mps = 0.2;
constexpr double kSlope_rad = 5 * kPi / 180;

// Sums, step by step, where the energy goes. A step's work is its forces times the mean of the
// speeds before and after it.
class Account {
 public:
  Account(Rig& rig, const Rig& truth)
      : rig_(rig),
        true_motors_(truth.scene().model.get()),
        before_(static_cast<std::size_t>(Model()->nv)) {
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
    battery_j_ += MotorsPower(rig_) * m->opt.timestep;
    heat_j_ += heat_w * m->opt.timestep;
  }
  double battery_j() const { return battery_j_; }
  double heat_j() const { return heat_j_; }
  // What the battery gave that did not become heat: kinetic and potential energy.
  double left_j() const { return battery_j_ - heat_j_; }
  double kinetic_j() const { return Kinetic() - kinetic_j_; }

 private:
  const mjModel* Model() const { return rig_.sim().model(); }
  double Speed(int dof) const {
    return (before_[static_cast<std::size_t>(dof)] + rig_.data()->qvel[dof]) / 2;
  }
  // Of windings, and of a driver that brakes: what it would return.
  double MotorHeat(int a) const {
    const mjtNum* gain = true_motors_->actuator_gainprm + mjNGAIN * a;
    const double resistance_ohm = gain[0], constant = gain[1];
    const double torque_nm = MotorTorque(Model(), rig_.data(), a);
    const double current_a = torque_nm / constant;
    const double windings_w = resistance_ohm * current_a * current_a;
    const int dof = Model()->jnt_dofadr[Model()->actuator_trnid[2 * a]];
    return windings_w + std::max(0.0, -(windings_w + torque_nm * Speed(dof)));
  }
  double Kinetic() const {
    const mjModel* m = Model();
    const DataPtr now(mj_copyData(nullptr, m, rig_.data()));
    ForwardEngine(m, now.get());
    mj_energyVel(m, now.get());
    return now->energy[1];
  }

  Rig& rig_;
  const mjModel* true_motors_;
  std::vector<double> before_;  // speeds before the step
  double kinetic_j_ = 0, battery_j_ = 0, heat_j_ = 0;
};

class Energy final : public Law {
 public:
  std::string_view statement() const override {
    return "integral of v i dt = kinetic + potential + losses: n (T omega + R (T / K)^2) with "
           "T = T_f + b omega + F r / n, and m g h on a step";
  }
  std::vector<WrongModel> notices() const override { return {kLargerWheels, kMoreResistance}; }

  void Check(const WrongModel& wrong, std::vector<LawRow>& rows) const override {
    const auto robot = [&](const char* name, double step_m) {
      const Rig truth(name);
      Steady(truth, "flat", 0, wrong, rows);
      Steady(truth, "uphill", kSlope_rad, wrong, rows);
      Steady(truth, "downhill", -kSlope_rad, wrong, rows);
      Start(truth, wrong, rows);
      Step(truth, step_m, wrong, rows);
    };
    robot("beluga", 0.008);
    robot("htetro", 0.010);
    // Uphill its tyres creep by as much as this compares.
    Steady(Rig("rover"), "flat", 0, wrong, rows);
  }

 private:
  static void Steady(const Rig& truth, const std::string& name, double slope_rad,
                     const WrongModel& wrong, std::vector<LawRow>& rows) {
    constexpr double kSteady_s = 2, kDrive_s = 2;
    const SteadyDrive expected =
        DriveSteadily(truth, kSpeed_mps, Weight(truth.robot()) * std::sin(slope_rad));
    Rig rig(truth.robot().name, {.wrong = wrong});
    rig.SetGravity({-std::sin(slope_rad), 0, -std::cos(slope_rad)});
    rig.Run({kSpeed_mps, 0, 0}, kSteady_s);
    Account account(rig, truth);
    const double start_s = rig.truth().t_s;
    while (rig.truth().t_s < start_s + kDrive_s) account.Step();
    const double time_s = rig.truth().t_s - start_s;
    const auto row = [&](const char* what, double expected_w, double measured_j) {
      rows.push_back({"energy/" + truth.robot().name + "/" + name + "/" + what, expected_w,
                      measured_j / time_s, kSteadyShare * expected_w, "W"});
    };
    if (expected.power_w > 0) row("power", expected.power_w, account.battery_j());
    row("losses",
        expected.power_w - Weight(truth.robot()) * expected.speed_mps * std::sin(slope_rad),
        account.heat_j());
  }

  // From rest to the speed on flat floor: m v^2 / 2, and the wheels' and rotors' own turning.
  static void Start(const Rig& truth, const WrongModel& wrong, std::vector<LawRow>& rows) {
    constexpr double kRamp_s = 0.5, kDrive_s = 1.5;
    const RobotSpec& robot = truth.robot();
    RigOptions options{.wrong = wrong};
    options.physics.timestep_s = kFine_s;
    Rig rig(robot.name, std::move(options));
    Account account(rig, truth);
    while (rig.truth().t_s < kDrive_s) {
      rig.Command({kSpeed_mps * std::min(1.0, rig.truth().t_s / kRamp_s), 0, 0});
      account.Step();
    }
    const mjModel* m = truth.scene().model.get();
    const int dof = m->jnt_dofadr[m->actuator_trnid[0]], wheel = m->dof_bodyid[dof];
    // About its axle, y; as an inertia whose axes MuJoCo may have permuted: the odd one of three.
    const mjtNum* inertia = m->body_inertia + 3 * wheel;
    const double axle = *std::max_element(inertia, inertia + 3) + m->dof_armature[dof];
    const double radius_m = robot.wheels.front().radius_m;
    const double mass_kg =
        robot.mass_kg + static_cast<double>(robot.wheels.size()) * axle / (radius_m * radius_m);
    const double kinetic_j = mass_kg * kSpeed_mps * kSpeed_mps / 2;
    rows.push_back({"energy/" + robot.name + "/start/kinetic", kinetic_j, account.left_j(),
                    kStartShare * kinetic_j, "J"});
  }

  // From flat floor onto a raised one, all wheels up.
  static void Step(const Rig& truth, double height_m, const WrongModel& wrong,
                   std::vector<LawRow>& rows) {
    constexpr double kEdge_m = 0.45, kDrive_s = 4.5;
    const Polygon raised = {{kEdge_m, -3}, {9, -3}, {9, 3}, {kEdge_m, 3}};
    RigOptions options{.wrong = wrong};
    options.physics.timestep_s = kFine_s;
    options.hazards = {Prism("step", raised, {}, height_m)};
    Rig rig(truth.robot().name, std::move(options));
    rig.Run({kSpeed_mps, 0, 0}, 0.5);
    Account account(rig, truth);
    const double start_s = rig.truth().t_s;
    while (rig.truth().t_s < start_s + kDrive_s) account.Step();
    const double potential_j = Weight(truth.robot()) * height_m;
    rows.push_back({"energy/" + truth.robot().name + "/step/potential", potential_j,
                    account.left_j() - account.kinetic_j(), kStepShare * potential_j, "J"});
  }
};

}  // namespace

FP_DEFINE_PLUGIN(Law, Energy)

}  // namespace floorproof
