// SPDX-License-Identifier: Apache-2.0
#include "env/scene/driving_power.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>
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
  Vec2 p_W;
  std::optional<double> load_n;  // by the spring that it slides on; none: it has no spring
};

// By the spring between it and the chassis and by what hangs below that.
std::optional<double> SprungLoad(const mjModel* m, const RobotSpec& robot, int body) {
  for (; body > 0 && !IsChassis(m, body, robot); body = m->body_parentid[body])
    for (int j = m->body_jntadr[body]; j >= 0 && j < m->body_jntadr[body] + m->body_jntnum[body];
         ++j) {
      if (m->jnt_type[j] != mjJNT_SLIDE) continue;
      const int q = m->jnt_qposadr[j];
      return m->jnt_axis[3 * j + 2] * m->jnt_stiffness[j] * (m->qpos0[q] - m->qpos_spring[q]) +
             m->body_subtreemass[body] * kGravity_mps2;
    }
  return {};
}

// Of what stands on no spring: the rest of the weight lies on a plane over their places.
void ShareTheRest(const mjModel* m, const mjData* d, int base, std::vector<Carrier>& carriers) {
  const double weight_n = m->body_subtreemass[base] * kGravity_mps2;
  const mjtNum* com = d->subtree_com + 3 * base;
  Vec3 rest = weight_n * Vec3(1, com[0], com[1]);
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  for (const Carrier& c : carriers) {
    const Vec3 at(1, c.p_W.x(), c.p_W.y());
    if (c.load_n)
      rest -= *c.load_n * at;
    else
      normal += at * at.transpose();
  }
  const Vec3 plane = normal.completeOrthogonalDecomposition().solve(rest);
  for (Carrier& c : carriers)
    if (!c.load_n) c.load_n = std::max(0.0, plane.dot(Vec3(1, c.p_W.x(), c.p_W.y())));
}

std::vector<Carrier> Carriers(const mjModel* m, const RobotSpec& robot) {
  const int base = mj_name2id(m, mjOBJ_BODY, "base");
  const DataPtr d = MakeData(m);
  ForwardEngine(m, d.get());
  std::vector<Carrier> carriers;
  for (int g = 0; g < m->ngeom; ++g) {
    const int body = m->geom_bodyid[g];
    if (m->body_rootid[body] != base || IsChassis(m, body, robot)) continue;
    if (m->geom_contype[g] == 0 && m->geom_conaffinity[g] == 0) continue;
    const Vec2 p_W(d->geom_xpos[3 * g], d->geom_xpos[3 * g + 1]);
    carriers.push_back({g, p_W, SprungLoad(m, robot, body)});
  }
  ShareTheRest(m, d.get(), base, carriers);
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
      drag_n += m->geom_friction[3 * carrier.geom] * *carrier.load_n;
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
