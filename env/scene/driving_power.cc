// SPDX-License-Identifier: Apache-2.0
#include "env/scene/driving_power.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "env/core/battery.h"
#include "env/scene/engine.h"
#include "env/scene/robot_model.h"

namespace floorproof {
namespace {

constexpr double kGravity_mps2 = 9.81;

// A geom that carries the robot, as it stands in its model.
struct Carrier {
  int geom;
  Vec3 lever;                         // 1, x and y, m: what its load does
  double load_n = 0;                  // by the spring that it slides on and what hangs below that
  double stiffness_npm = kRigid_npm;  // of that spring

  static constexpr double kRigid_npm = 1e9;
};

Carrier MakeCarrier(const mjModel* m, const mjData* d, const RobotSpec& robot, int geom) {
  Carrier out{geom, {1, d->geom_xpos[3 * geom], d->geom_xpos[3 * geom + 1]}};
  for (int body = m->geom_bodyid[geom]; body > 0 && !IsChassis(m, body, robot);
       body = m->body_parentid[body])
    for (int k = 0; k < m->body_jntnum[body]; ++k) {
      const int j = m->body_jntadr[body] + k, q = m->jnt_qposadr[j];
      if (m->jnt_type[j] != mjJNT_SLIDE) continue;
      out.stiffness_npm = m->jnt_stiffness[j];
      out.load_n =
          m->jnt_axis[3 * j + 2] * m->jnt_stiffness[j] * (m->qpos0[q] - m->qpos_spring[q]) +
          m->body_subtreemass[body] * kGravity_mps2;
      return out;
    }
  return out;
}

// Where the springs do not carry what stands on them the body heaves, pitches and rolls until they
// do: loads then lie on a plane over the places, each times its spring's stiffness.
void Balance(double weight_n, const mjtNum* com, std::vector<Carrier>& carriers) {
  constexpr double kStands = 0.01;  // share of the weight that may be off: it stands as it is drawn
  Vec3 off = weight_n * Vec3(1, com[0], com[1]);
  Eigen::Matrix3d stiffness = Eigen::Matrix3d::Zero();
  for (const Carrier& c : carriers) {
    off -= c.load_n * c.lever;
    stiffness += c.stiffness_npm * c.lever * c.lever.transpose();
  }
  const Vec3 sinks = stiffness.completeOrthogonalDecomposition().solve(off);
  const auto more_n = [&](const Carrier& c) { return c.stiffness_npm * sinks.dot(c.lever); };
  const bool stands = std::ranges::all_of(carriers, [&](const Carrier& c) {
    return c.stiffness_npm == Carrier::kRigid_npm || std::abs(more_n(c)) <= kStands * weight_n;
  });
  for (Carrier& c : carriers)
    if (!stands || c.stiffness_npm == Carrier::kRigid_npm)
      c.load_n = std::max(0.0, c.load_n + more_n(c));
}

std::vector<Carrier> Carriers(const mjModel* m, const RobotSpec& robot) {
  const int base = mj_name2id(m, mjOBJ_BODY, "base");
  const DataPtr d = MakeData(m);
  ForwardEngine(m, d.get());
  std::vector<Carrier> carriers;
  for (int g = 0; g < m->ngeom; ++g) {
    const int body = m->geom_bodyid[g];
    if (m->body_rootid[body] != base || IsChassis(m, body, robot)) continue;
    if (m->geom_contype[g] != 0 || m->geom_conaffinity[g] != 0)
      carriers.push_back(MakeCarrier(m, d.get(), robot, g));
  }
  Balance(m->body_subtreemass[base] * kGravity_mps2, d->subtree_com + 3 * base, carriers);
  return carriers;
}

// The joint on which the body rolls: a hinge that does not stand upright, or a ball; -1: it has
// none.
int RollingJoint(const mjModel* m, int body) {
  constexpr double kUpright = 0.7;
  for (int j = m->body_jntadr[body]; j >= 0 && j < m->body_jntadr[body] + m->body_jntnum[body]; ++j)
    if (m->jnt_type[j] == mjJNT_BALL ||
        (m->jnt_type[j] == mjJNT_HINGE && std::abs(m->jnt_axis[3 * j + 2]) < kUpright))
      return j;
  return -1;
}

}  // namespace

double CasterDrag(const mjModel* m, const RobotSpec& robot, double speed_mps) {
  std::vector<int> driven;
  for (const WheelSpec& wheel : robot.wheels)
    if (const int a = mj_name2id(m, mjOBJ_ACTUATOR, wheel.name.c_str()); a >= 0)
      driven.push_back(m->jnt_bodyid[m->actuator_trnid[2 * a]]);
  double drag_n = 0;
  for (const Carrier& carrier : Carriers(m, robot)) {
    const int body = m->geom_bodyid[carrier.geom];
    if (std::ranges::find(driven, body) != driven.end()) continue;
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
