// SPDX-License-Identifier: Apache-2.0
#include "env/scene/robot_limits.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/error.h"

namespace floorproof {
namespace {

constexpr int kMaxBodies = 1000, kMaxGeoms = 2000, kMaxMotors = 100;
constexpr const char* kBeside =
    "stands beside the robot: the file holds the robot alone, floors and things come from the site";
constexpr double kMaxBasePlace_m = 1000;  // it is put elsewhere; where it stands is lost digits

void RefuseMany(const char* what, int number, int most, const std::string& file) {
  if (number > most)
    throw InputError({file, 0}, what, std::to_string(number),
                     "must be at most " + std::to_string(most));
}

std::string NameOf(const mjModel* m, mjtObj type, int id) {
  const char* name = mj_id2name(m, type, id);
  return std::string(type == mjOBJ_BODY ? "body " : "geom ") +
         (name != nullptr && *name != '\0' ? name : std::to_string(id).c_str());
}

// The farthest that a body's joints take it from where the file puts it.
double JointReach(const mjModel* m, int body) {
  double reach = 0;
  for (int j = m->body_jntadr[body]; j < m->body_jntadr[body] + m->body_jntnum[body]; ++j) {
    const mjtNum* range = m->jnt_range + 2 * j;
    if (m->jnt_type[j] != mjJNT_SLIDE)
      reach += 2 * mju_norm3(m->jnt_pos + 3 * j);  // half a turn about it
    else if (m->jnt_limited[j])
      reach += std::max(std::abs(range[0]), std::abs(range[1]));
  }
  return reach;
}

}  // namespace

void RefuseBeyondLimits(const mjModel* m, const std::string& file) {
  RefuseMany("bodies", static_cast<int>(m->nbody), kMaxBodies, file);
  RefuseMany("geoms", static_cast<int>(m->ngeom), kMaxGeoms, file);
  RefuseMany("actuators", static_cast<int>(m->nu), kMaxMotors, file);
  const auto refuse = [&](mjtObj type, int id, double value, const std::string& rule) {
    throw InputError({file, 0}, NameOf(m, type, id), FormatDouble(value), rule);
  };
  const int base = mj_name2id(m, mjOBJ_BODY, "base");
  if (m->nflex > 0)
    throw InputError({file, 0}, "flex", std::to_string(m->nflex), "a robot's parts are rigid");
  for (int b = 1; b < m->nbody; ++b)
    if (base >= 0 && m->body_rootid[b] != m->body_rootid[base])
      throw InputError({file, 0}, NameOf(m, mjOBJ_BODY, b), "", kBeside);
  for (int g = 0; g < m->ngeom; ++g)
    if (m->geom_bodyid[g] == 0) throw InputError({file, 0}, NameOf(m, mjOBJ_GEOM, g), "", kBeside);
  // Bodies' distances along the tree: no less than they are in any position of the joints that have
  // ends, or turn. A child stands behind its parent.
  std::vector<double> away(static_cast<std::size_t>(m->nbody), 0.0);
  for (int b = 1; b < m->nbody; ++b) {
    const double step = mju_norm3(m->body_pos + 3 * b);
    if (b == base && !(step <= kMaxBasePlace_m))
      refuse(mjOBJ_BODY, b, step, "must stand within " + FormatDouble(kMaxBasePlace_m) + " m");
    double& here = away[static_cast<std::size_t>(b)];
    if (b != base)
      here = away[static_cast<std::size_t>(m->body_parentid[b])] + step + JointReach(m, b);
    if (!(here <= kMaxReach_m))
      refuse(mjOBJ_BODY, b, here,
             "must be within " + FormatDouble(kMaxReach_m) + " m of the robot's base");
  }
  for (int g = 0; g < m->ngeom; ++g) {
    const double reach = away[static_cast<std::size_t>(m->geom_bodyid[g])] +
                         mju_norm3(m->geom_pos + 3 * g) + m->geom_rbound[g];
    if (!(reach <= kMaxReach_m))
      refuse(mjOBJ_GEOM, g, reach,
             "must end within " + FormatDouble(kMaxReach_m) + " m of the robot's base");
  }
  if (base < 0) return;
  const double mass_kg = m->body_subtreemass[base];
  if (!kMass_kg.Allows(mass_kg)) refuse(mjOBJ_BODY, base, mass_kg, "mass (kg) " + kMass_kg.Text());
}

}  // namespace floorproof
