// SPDX-License-Identifier: Apache-2.0
// A DC motor in steady state, its robot lifted off the floor and every wheel braked by a torque
// T_L: with resistance R, constant K (torque per ampere = back-EMF per rad/s), dry friction T_f and
// damping b at the joint,
//
//   v = R i + K omega,  K i = T_f + b omega + T_L,  T_stall = min(K V / R, the driver's limit),
//
// where the driver gives what holds the speed asked for, T = k (u - omega), and at most the
// battery's voltage V. The battery's current is (sum of v i + hotel load) / V: Hughes & Drury,
// "Electric Motors and Drives", ch. 3; MuJoCo's technical note on `dcmotor`, sections 1.1 and 2.5.
//
// Tolerance: 0.2 %. Steady states agree to six digits; a blocked wheel is one that is too heavy to
// get going, and still turns a little.
#include <algorithm>

#include "validate/law.h"

namespace floorproof {
namespace {

constexpr double kShare = 0.002;
constexpr double kFull_radps = 1000;  // asked for, so that the driver gives all it can

// What the true model says of a motor at its wheel, and the driver's least.
struct Motor {
  double resistance_ohm, constant, gain, friction_nm, damping, most_nm, battery_v;

  Motor(const mjModel* m, double volt) : battery_v(volt) {
    const int dof = m->jnt_dofadr[m->actuator_trnid[0]];
    resistance_ohm = m->actuator_gainprm[0];
    constant = m->actuator_gainprm[1];
    gain = m->actuator_gainprm[6];
    friction_nm = m->dof_frictionloss[dof];
    damping = m->dof_damping[dof];
    most_nm = constant * volt / resistance_ohm;
    if (m->actuator_forcelimited[0]) most_nm = std::min(most_nm, m->actuator_forcerange[1]);
  }
  // At full voltage under a load.
  double Speed(double load_nm) const {
    return (constant * battery_v / resistance_ohm - friction_nm - load_nm) /
           (constant * constant / resistance_ohm + damping);
  }
  double Torque(double speed_radps, double load_nm) const {
    return friction_nm + damping * speed_radps + load_nm;
  }
  double Power(double torque_nm, double speed_radps) const {
    const double i = torque_nm / constant;
    return i * (resistance_ohm * i + constant * speed_radps);
  }
};

// A robot in the air whose body does not turn when its wheels are braked.
class Bench {
 public:
  Bench(const std::string& robot, const WrongModel& wrong) : rig_(robot, {.wrong = wrong}) {
    // More would blunt the solver, whose tolerance is relative to the mean inertia.
    constexpr double kHeld = 100;  // kg and kg m^2
    rig_.SetGravity(Vec3::Zero());
    rig_.SetBase(Vec3::UnitZ(), Eigen::Quaterniond::Identity(), Vec3::Zero());
    mjModel* m = rig_.sim().model();
    std::fill_n(m->dof_armature + m->body_dofadr[rig_.scene().base_body], 6, kHeld);
  }
  int num_wheels() const { return static_cast<int>(rig_.robot().wheels.size()); }
  double wheels() const { return num_wheels(); }
  double hotel_w() const { return rig_.robot().hotel_load_w; }

  // Asks every driver for a speed under a load until nothing changes.
  void Run(double command_radps, double load_nm) {
    constexpr int kSteps = 1000;
    for (int a = 0; a < num_wheels(); ++a) rig_.data()->qfrc_applied[Dof(a)] = -load_nm;
    rig_.CommandWheels(command_radps);
    for (int k = 0; k < kSteps; ++k) rig_.Step();
  }
  // Holds every wheel still, by its inertia.
  void Block() {
    constexpr double kBlocked_kgm2 = 3e4;  // 20 N m turn it by 3 mrad/s in a run
    mjModel* m = rig_.sim().model();
    for (int a = 0; a < num_wheels(); ++a) m->dof_armature[Dof(a)] = kBlocked_kgm2;
    rig_.SetBase(Vec3::UnitZ(), Eigen::Quaterniond::Identity(), Vec3::Zero());
    for (int a = 0; a < m->nu; ++a) rig_.data()->qvel[Dof(a)] = 0;
  }
  double speed_radps() { return rig_.data()->qvel[Dof(0)]; }
  double torque_nm() { return rig_.data()->actuator_force[0]; }
  double battery_a() const { return rig_.truth().battery_a; }

 private:
  int Dof(int actuator) {
    const mjModel* m = rig_.sim().model();
    return m->jnt_dofadr[m->actuator_trnid[2 * actuator]];
  }
  Rig rig_;
};

class Motors final : public Law {
 public:
  std::string_view statement() const override {
    return "v = R i + K omega, K i = T_f + b omega + T_L, v <= V, and the battery's current is "
           "(sum of v i + hotel load) / V";
  }
  std::vector<WrongModel> notices() const override {
    return {{.battery_factor = 0.95}, kMoreResistance};
  }

  void Check(const WrongModel& wrong, std::vector<LawRow>& rows) const override {
    for (const RobotEntry& robot : Robots()) CheckRobot(std::string(robot.name), wrong, rows);
  }

 private:
  static void CheckRobot(const std::string& robot, const WrongModel& wrong,
                         std::vector<LawRow>& rows) {
    const auto add = [&](const std::string& name, double expected, double measured,
                         const char* unit) {
      rows.push_back(
          {"motors/" + robot + "/" + name, expected, measured, kShare * std::abs(expected), unit});
    };
    Bench bench(robot, wrong);
    const Rig truth(robot);
    const Motor motor(truth.scene().model.get(), *truth.robot().battery.voltage_v);
    const auto battery_a = [&](double torque_nm, double speed_radps) {
      return (bench.wheels() * motor.Power(torque_nm, speed_radps) + bench.hotel_w()) /
             motor.battery_v;
    };
    const auto at_full_voltage = [&](const std::string& name, double load_nm) {
      const double speed = motor.Speed(load_nm);
      bench.Run(kFull_radps, load_nm);
      add(name + "/speed", speed, bench.speed_radps(), "rad/s");
      add(name + "/current", battery_a(motor.Torque(speed, load_nm), speed), bench.battery_a(),
          "A");
    };
    at_full_voltage("free", 0);
    at_full_voltage("half_load", motor.most_nm / 2);
    // Pushed on by as much as its bearing takes, a motor runs at its back-EMF and draws nothing.
    const double emf_radps = motor.battery_v / motor.constant;
    at_full_voltage("back_emf", -motor.Torque(emf_radps, 0));

    const double asked = emf_radps / 3, quarter = motor.most_nm / 4;
    const double held =
        (motor.gain * asked - motor.friction_nm - quarter) / (motor.gain + motor.damping);
    bench.Run(asked, quarter);
    add("held/speed", held, bench.speed_radps(), "rad/s");
    add("held/current", battery_a(motor.Torque(held, quarter), held), bench.battery_a(), "A");

    bench.Block();
    bench.Run(kFull_radps, 0);
    add("stall/torque", motor.most_nm, bench.torque_nm(), "N m");
    add("stall/current", battery_a(motor.most_nm, 0), bench.battery_a(), "A");
  }
};

}  // namespace

FP_DEFINE_PLUGIN(Law, Motors)

}  // namespace floorproof
