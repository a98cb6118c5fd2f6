// SPDX-License-Identifier: Apache-2.0
#include "env/sim/divergence.h"

#include <algorithm>
#include <cstdio>

namespace floorproof {
namespace {

// Whose index a warning gives.
enum class Index { kDof, kCoordinate, kNone };
struct Warning {
  mjtWarning warning;
  Index index;
};
// In the order in which they tell the most: an acceleration comes before the speed that it makes.
constexpr Warning kWarnings[] = {
    {mjWARN_BADQACC, Index::kDof},        {mjWARN_BADQVEL, Index::kDof},
    {mjWARN_BADQPOS, Index::kCoordinate}, {mjWARN_INERTIA, Index::kDof},
    {mjWARN_CONTACTFULL, Index::kNone},   {mjWARN_CNSTRFULL, Index::kNone},
};

std::string NameOf(const mjModel* m, mjtObj type, int id) {
  const char* name = mj_id2name(m, type, id);
  return name != nullptr && *name != '\0' ? "'" + std::string(name) + "'" : std::to_string(id);
}

// -1: the index is no joint's.
int JointOf(const mjModel* m, Index index, int at) {
  if (at < 0 || at >= (index == Index::kDof ? m->nv : m->nq)) return -1;
  if (index == Index::kDof) return m->dof_jntid[at];
  return static_cast<int>(std::upper_bound(m->jnt_qposadr, m->jnt_qposadr + m->njnt, at) -
                          m->jnt_qposadr) -
         1;
}

}  // namespace

bool HasDiverged(const mjData* data) {
  return std::ranges::any_of(kWarnings,
                             [&](const Warning& w) { return data->warning[w.warning].number > 0; });
}

std::string DescribeDivergence(const mjModel* m, const mjData* d, int base) {
  char time[32];
  std::snprintf(time, sizeof time, " at %.3f s", d->time);
  for (const Warning& w : kWarnings) {
    if (d->warning[w.warning].number == 0) continue;
    if (w.index == Index::kNone)
      return std::string("more contacts than MuJoCo has room for") + time;
    const int joint = JointOf(m, w.index, d->warning[w.warning].lastinfo);
    if (joint < 0) break;
    return "body " + NameOf(m, mjOBJ_BODY, m->jnt_bodyid[joint]) + " (joint " +
           NameOf(m, mjOBJ_JOINT, joint) + ")" + time;
  }
  return "body " + NameOf(m, mjOBJ_BODY, base) + time;
}

}  // namespace floorproof
