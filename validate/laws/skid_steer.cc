// SPDX-License-Identifier: Apache-2.0
// A skid-steer turns by sliding. With equal loads N on four wheels at (+-a, +-b) and friction mu
// that is the same in all directions, a wheel that the yaw rate w drags across at w a, and that
// rolls w s faster than its place moves, is held by mu N (s, a) / sqrt(a^2 + s^2). The yaw moments
// of what is along and what is across cancel where
//
//   sum_i (x_i^2 - b s) / sqrt(x_i^2 + s^2) = 0:   s = a^2 / b,
//
// whatever mu is. So the robot turns as one of half track b + s whose wheels do not slide:
//
//   w = (v_r - v_l) / (2 (b + s)),   T = T_f + c omega + mu N R s / sqrt(a^2 + s^2)
//
// with the speed omega that a wheel truly has, and the battery gives T omega + R_m (T / K)^2 a
// motor. On the spot all four do so alike; in an arc the centripetal force is not in this, and the
// row is of the turn alone.
//
// Tolerances: rate and torque 0.5 %, power 1 %. The tread is 10 mm wide, not a point, and a tyre
// creeps a little (env/scene/tyre.h): 0.2 % each.
#include <fmt/format.h>

#include "env/core/battery.h"
#include "validate/law.h"

namespace floorproof {
namespace {

constexpr double kRateShare = 0.005, kTorqueShare = 0.005;

// Means over a steady turn.
struct Turn {
  double rate_radps = 0, left_radps = 0, right_radps = 0, torque_nm = 0, power_w = 0;
};

// Drives the twist; the first half of the time is for it to become steady.
Turn Measure(Rig& rig, const BodyTwist& twist) {
  constexpr double kTime_s = 4;
  const auto steps = static_cast<int>(kTime_s / rig.sim().model()->opt.timestep);
  const mjModel* m = rig.sim().model();
  Turn mean;
  rig.Command(twist);
  for (int k = 0; k < steps; ++k) {
    rig.Step();
    if (k < steps / 2) continue;
    const double share = 2.0 / steps;
    mean.rate_radps += share * rig.truth().V_WB_B.wz_radps;
    mean.power_w += share * (rig.truth().power_w - rig.robot().hotel_load_w);
    const auto n = static_cast<double>(rig.robot().wheels.size());
    for (int a = 0; a < m->nu; ++a) {
      const double radps = rig.data()->qvel[m->jnt_dofadr[m->actuator_trnid[2 * a]]];
      const bool left = rig.robot().wheels[static_cast<std::size_t>(a)].p_BW.y() > 0;
      (left ? mean.left_radps : mean.right_radps) += 2 / n * share * radps;
      mean.torque_nm += share * std::abs(rig.sim().motor_nm()[static_cast<std::size_t>(a)]) / n;
    }
  }
  return mean;
}

class SkidSteer final : public Law {
 public:
  std::string_view statement() const override {
    return "four wheels at (+-a, +-b) that slide: w = (v_r - v_l) / (2 (b + a^2 / b)) whatever the "
           "friction, T = T_f + c omega + mu N R s / sqrt(a^2 + s^2) with s = a^2 / b";
  }
  std::vector<WrongModel> notices() const override { return {kLargerWheels, kMoreFriction}; }

  void Check(const WrongModel& wrong, std::vector<LawRow>& rows) const override {
    for (const double mu : {0.4, 0.8}) {
      const RigOptions options{.friction = mu, .wrong = wrong};
      const std::string law = fmt::format("skid/rover/mu{}", mu);
      for (const double turn_radps : {0.5, -1.0}) OnTheSpot(law, turn_radps, mu, options, rows);
      Rig arc("rover", options);
      const Turn turn = Measure(arc, {0.3, 0, 0.5});
      Rate(law + "/arc", arc.robot(), turn, rows);
    }
  }

 private:
  static double Slide(const RobotSpec& robot) {  // s
    const Vec3& p = robot.wheels.front().p_BW;
    return p.x() * p.x() / std::abs(p.y());
  }

  static void Rate(const std::string& law, const RobotSpec& robot, const Turn& turn,
                   std::vector<LawRow>& rows) {
    const WheelSpec& wheel = robot.wheels.front();
    const double rims_mps = wheel.radius_m * (turn.right_radps - turn.left_radps);
    const double rate = rims_mps / 2 / (std::abs(wheel.p_BW.y()) + Slide(robot));
    rows.push_back({law + "/rate", rate, turn.rate_radps, kRateShare * std::abs(rate), "rad/s"});
  }

  static void OnTheSpot(const std::string& law, double turn_radps, double mu,
                        const RigOptions& options, std::vector<LawRow>& rows) {
    Rig rig("rover", options);
    const RobotSpec& robot = rig.robot();
    const Turn turn = Measure(rig, {0, 0, turn_radps});
    const std::string name = fmt::format("{}/turn{}", law, turn_radps);
    Rate(name, robot, turn, rows);

    const Rig truth("rover");
    const mjModel* m = truth.scene().model.get();
    const int dof = m->jnt_dofadr[m->actuator_trnid[0]];
    const WheelSpec& wheel = robot.wheels.front();
    const double omega = std::abs(turn.right_radps - turn.left_radps) / 2;
    const auto n = static_cast<double>(robot.wheels.size());
    const double slide_m = Slide(robot), grip_n = mu * robot.mass_kg * kGravity_mps2 / n;
    const double torque_nm =
        m->dof_frictionloss[dof] + m->dof_damping[dof] * omega +
        grip_n * wheel.radius_m * slide_m / std::hypot(wheel.p_BW.x(), slide_m);
    const double power_w =
        n * MotorPower(torque_nm, omega, m->actuator_gainprm[0], m->actuator_gainprm[1]);
    rows.push_back({name + "/torque", torque_nm, turn.torque_nm, kTorqueShare * torque_nm, "N m"});
    rows.push_back({name + "/power", power_w, turn.power_w, 2 * kTorqueShare * power_w, "W"});
  }
};

}  // namespace

FP_DEFINE_PLUGIN(Law, SkidSteer)

}  // namespace floorproof
