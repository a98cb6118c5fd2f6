// SPDX-License-Identifier: Apache-2.0
#include "validate/steady_drive.h"

#include <algorithm>

#include "env/scene/driving_power.h"

namespace floorproof {

double Weight(const RobotSpec& robot) { return robot.mass_kg * kGravity_mps2; }
double MotorsPower(const Rig& rig) { return rig.truth().power_w - rig.robot().hotel_load_w; }

SteadyDrive DriveSteadily(const Rig& truth, double speed_mps, double force_n) {
  const RobotSpec& robot = truth.robot();
  const mjModel* m = truth.scene().model.get();
  const auto n = static_cast<double>(robot.wheels.size());
  const int dof = m->jnt_dofadr[m->actuator_trnid[0]];
  const double resistance = m->actuator_gainprm[0], constant = m->actuator_gainprm[1];
  const double gain = m->actuator_gainprm[6], damping = m->dof_damping[dof];
  const double radius_m = robot.wheels.front().radius_m;
  const double load_nm =
      m->dof_frictionloss[dof] + (CasterDrag(m, robot, speed_mps) + force_n) * radius_m / n;
  const double speed_radps = (gain * speed_mps / radius_m - load_nm) / (gain + damping);
  const double torque_nm = load_nm + damping * speed_radps, current_a = torque_nm / constant;
  const double power_w = torque_nm * speed_radps + resistance * current_a * current_a;
  return {n * std::max(0.0, power_w), speed_radps * radius_m};
}

}  // namespace floorproof
