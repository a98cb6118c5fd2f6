// SPDX-License-Identifier: Apache-2.0
#include "env/scene/robot_reach.h"

#include <algorithm>
#include <cmath>

namespace floorproof {
namespace {

constexpr double kFreeSlide_m = 0.5;  // the way of a slide joint without limits

double Distance(const mjtNum* a, const mjtNum* b) {
  mjtNum d[3];
  mju_sub3(d, a, b);
  return mju_norm3(d);
}

double DistanceToAxis(const mjtNum* p, const mjtNum* anchor, const mjtNum* axis) {
  mjtNum d[3], across[3];
  mju_sub3(d, p, anchor);
  mju_cross(across, d, axis);  // the axis is of length 1
  return mju_norm3(across);
}

}  // namespace

double TouchRadius(const mjModel* m, int geom) {
  return m->geom_rbound[geom] + std::max(0.0, m->geom_margin[geom]) +
         std::max(0.0, m->geom_gap[geom]);
}

bool NearnessIsKnown(const mjModel* m, int base_body) {
  if ((m->opt.enableflags & (mjENBL_SLEEP | mjENBL_OVERRIDE)) != 0) return false;
  for (int j = 0; j < m->njnt; ++j)
    if (m->body_rootid[m->jnt_bodyid[j]] != base_body) return false;
  return m->nmocap == 0 && m->nflex == 0;
}

std::vector<bool> CanTouch(const mjModel* m) {
  std::vector<bool> touches(static_cast<std::size_t>(m->ngeom));
  for (int g = 0; g < m->ngeom; ++g)
    touches[static_cast<std::size_t>(g)] = m->geom_contype[g] != 0 || m->geom_conaffinity[g] != 0;
  for (int i = 0; i < m->npair; ++i)
    for (const int g : {m->pair_geom1[i], m->pair_geom2[i]})
      touches[static_cast<std::size_t>(g)] = true;
  return touches;
}

RobotReach ComputeReach(const mjModel* m, int base_body) {
  const std::vector<bool> touches = CanTouch(m);
  RobotReach reach;
  reach.arm_m.assign(static_cast<std::size_t>(m->njnt), 0.0);
  // Per body, from its origin to what it and its descendants carry; -1: they carry nothing.
  // Children come after their parents.
  std::vector<double> extent(static_cast<std::size_t>(m->nbody), -1.0);
  double largest = 0;
  for (int b = static_cast<int>(m->nbody) - 1; b > 0; --b) {
    double& own = extent[static_cast<std::size_t>(b)];
    for (int g = m->body_geomadr[b]; g < m->body_geomadr[b] + m->body_geomnum[b]; ++g) {
      if (!touches[static_cast<std::size_t>(g)]) continue;
      own = std::max(own, mju_norm3(m->geom_pos + 3 * g));
      if (m->body_rootid[b] == m->body_rootid[base_body])
        largest = std::max(largest, TouchRadius(m, g));
    }
    double shift = 0;  // of the body's origin, by its own joints
    for (int j = m->body_jntadr[b]; j >= 0 && j < m->body_jntadr[b] + m->body_jntnum[b]; ++j) {
      const mjtNum *anchor = m->jnt_pos + 3 * j, *axis = m->jnt_axis + 3 * j;
      double& arm = reach.arm_m[static_cast<std::size_t>(j)];
      for (int g = m->body_geomadr[b]; g < m->body_geomadr[b] + m->body_geomnum[b]; ++g)
        if (touches[static_cast<std::size_t>(g)])
          arm = std::max(arm, DistanceToAxis(m->geom_pos + 3 * g, anchor, axis));
      for (int c = b + 1; c < m->nbody; ++c)
        if (m->body_parentid[c] == b && extent[static_cast<std::size_t>(c)] >= 0)
          arm = std::max(
              arm, Distance(m->body_pos + 3 * c, anchor) + extent[static_cast<std::size_t>(c)]);
      if (m->jnt_type[j] == mjJNT_SLIDE)
        shift += m->jnt_limited[j]
                     ? std::max(std::abs(m->jnt_range[2 * j]), std::abs(m->jnt_range[2 * j + 1]))
                     : kFreeSlide_m;
      else if (m->jnt_type[j] != mjJNT_FREE)
        shift += 2 * mju_norm3(anchor);
    }
    if (own < 0 || b == base_body) continue;
    double& parent = extent[static_cast<std::size_t>(m->body_parentid[b])];
    parent = std::max(parent, mju_norm3(m->body_pos + 3 * b) + shift + own);
  }
  reach.centres_m = std::max(0.0, extent[static_cast<std::size_t>(base_body)]);
  reach.surface_m = reach.centres_m + largest;
  return reach;
}

}  // namespace floorproof
