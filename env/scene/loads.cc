// SPDX-License-Identifier: Apache-2.0
#include "env/scene/loads.h"

#include <Eigen/Dense>
#include <algorithm>

#include "env/scene/engine.h"
#include "env/scene/robot_model.h"
#include "env/scene/robot_reach.h"

namespace floorproof {
namespace {

constexpr double kGravity_mps2 = 9.81;

// A wheel or caster in the model's pose.
struct Support {
  int geom;
  Vec3 lever;                         // 1, x and y, m: what its load does
  double load_n = 0;                  // of its spring, and of the parts below that
  double stiffness_npm = kRigid_npm;  // of that spring

  static constexpr double kRigid_npm = 1e9;
};

Support MakeSupport(const mjModel* m, const mjData* d, const RobotSpec& robot, int geom) {
  Support out{geom, {1, d->geom_xpos[3 * geom], d->geom_xpos[3 * geom + 1]}};
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

// If the springs in the model's pose do not balance the weight, the body heaves, pitches and rolls
// until they do: the loads then lie on a plane over the places, each times its spring's stiffness.
void Balance(double weight_n, const mjtNum* com, std::vector<Support>& supports) {
  constexpr double kStands = 0.01;  // share of the weight that may be off in the model's pose
  Vec3 off = weight_n * Vec3(1, com[0], com[1]);
  Eigen::Matrix3d stiffness = Eigen::Matrix3d::Zero();
  for (const Support& c : supports) {
    off -= c.load_n * c.lever;
    stiffness += c.stiffness_npm * c.lever * c.lever.transpose();
  }
  const Vec3 sinks = stiffness.completeOrthogonalDecomposition().solve(off);
  const auto more_n = [&](const Support& c) { return c.stiffness_npm * sinks.dot(c.lever); };
  const bool stands = std::ranges::all_of(supports, [&](const Support& c) {
    return c.stiffness_npm == Support::kRigid_npm || std::abs(more_n(c)) <= kStands * weight_n;
  });
  for (Support& c : supports)
    if (!stands || c.stiffness_npm == Support::kRigid_npm)
      c.load_n = std::max(0.0, c.load_n + more_n(c));
}

}  // namespace

std::vector<LoadedGeom> LoadsOf(const mjModel* m, const RobotSpec& robot) {
  const int base = mj_name2id(m, mjOBJ_BODY, "base");
  const DataPtr d = MakeData(m);
  ForwardEngine(m, d.get());
  const std::vector<bool> touches = CanTouch(m);
  std::vector<Support> supports;
  for (int g = 0; g < m->ngeom; ++g) {
    const int body = m->geom_bodyid[g];
    if (m->body_rootid[body] != base || IsChassis(m, body, robot)) continue;
    if (touches[static_cast<std::size_t>(g)]) supports.push_back(MakeSupport(m, d.get(), robot, g));
  }
  Balance(m->body_subtreemass[base] * kGravity_mps2, d->subtree_com + 3 * base, supports);
  std::vector<LoadedGeom> carriers;
  for (const Support& support : supports) carriers.push_back({support.geom, support.load_n});
  return carriers;
}

int RollingJoint(const mjModel* m, int body) {
  constexpr double kUpright = 0.7;
  for (int j = m->body_jntadr[body]; j >= 0 && j < m->body_jntadr[body] + m->body_jntnum[body]; ++j)
    if (m->jnt_type[j] == mjJNT_BALL ||
        (m->jnt_type[j] == mjJNT_HINGE && std::abs(m->jnt_axis[3 * j + 2]) < kUpright))
      return j;
  return -1;
}

bool IsDriven(const mjModel* m, int body) {
  for (int a = 0; a < m->nu; ++a)
    if (m->jnt_bodyid[m->actuator_trnid[2 * a]] == body) return true;
  return false;
}

}  // namespace floorproof
