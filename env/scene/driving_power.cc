// SPDX-License-Identifier: Apache-2.0
#include "env/scene/driving_power.h"

#include <algorithm>
#include <cmath>

#include "env/core/battery.h"

namespace floorproof {
namespace {

constexpr double kGravity_mps2 = 9.81;

}  // namespace

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

double SteadyMotorsPower(const mjModel* m, const RobotSpec& robot, double speed_mps) {
  const double drag_n = CasterDrag(m) / static_cast<double>(robot.wheels.size());
  double power_w = 0;
  for (const WheelSpec& wheel : robot.wheels) {
    const int a = mj_name2id(m, mjOBJ_ACTUATOR, wheel.name.c_str());
    if (a < 0) continue;
    const int dof = m->jnt_dofadr[m->actuator_trnid[2 * a]];
    const double speed_radps = std::abs(speed_mps) / wheel.radius_m;
    const double torque_nm =
        m->dof_frictionloss[dof] + m->dof_damping[dof] * speed_radps + drag_n * wheel.radius_m;
    const mjtNum* gain = m->actuator_gainprm + mjNGAIN * a;
    power_w += MotorPower(torque_nm, speed_radps, gain[0], gain[1]);
  }
  return power_w;
}

}  // namespace floorproof
