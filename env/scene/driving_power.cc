// SPDX-License-Identifier: Apache-2.0
#include "env/scene/driving_power.h"

#include <cmath>

#include "env/core/battery.h"
#include "env/scene/loads.h"

namespace floorproof {

double CasterDrag(const mjModel* m, const RobotSpec& robot, double speed_mps) {
  double drag_n = 0;
  for (const LoadedGeom& carrier : LoadsOf(m, robot)) {
    const int body = m->geom_bodyid[carrier.geom];
    if (IsDriven(m, body)) continue;
    if (const int joint = RollingJoint(m, body); joint >= 0) {
      const int dof = m->jnt_dofadr[joint];
      const double radius_m = m->geom_size[3 * carrier.geom];
      drag_n += (m->dof_frictionloss[dof] + m->dof_damping[dof] * std::abs(speed_mps) / radius_m) /
                radius_m;
    } else {
      drag_n += m->geom_friction[3 * carrier.geom] * carrier.load_n;
    }
  }
  return drag_n;
}

double SteadyMotorsPower(const mjModel* m, const RobotSpec& robot, double speed_mps) {
  const double drag_n = CasterDrag(m, robot, speed_mps) / static_cast<double>(robot.wheels.size());
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
