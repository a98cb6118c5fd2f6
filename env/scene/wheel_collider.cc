// SPDX-License-Identifier: Apache-2.0
#include "env/scene/wheel_collider.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace floorproof {
namespace {

constexpr int kMaxContacts = 50;        // what MuJoCo's colliders give at most
constexpr double kSameNormal = 0.9995;  // cosine: planes within 2 degrees are one
constexpr double kBlend_m = 1e-4;       // contacts deeper than others by this rule alone
constexpr std::array kOthers = {mjGEOM_PLANE, mjGEOM_HFIELD, mjGEOM_BOX, mjGEOM_MESH};

// The third of a marked wheel's user data. Other programs' models in this process may have user
// data of their own, and are to be left alone.
constexpr double kPaired = 2718281.828;

std::array<mjfCollision, kOthers.size()> g_original;

bool IsPaired(const mjModel* m, int geom) {
  return m->nuser_geom >= 3 && m->geom_type[geom] == mjGEOM_CYLINDER &&
         m->geom_user[m->nuser_geom * geom + 2] == kPaired;
}

// The core's contacts become the rounded wheel's: nearer by the roller's radius, each at the middle
// of the gap. `toward_wheel` is 1 when the normals point to the wheel.
void Inflate(mjPreContact* con, int n, double radius_m, double toward_wheel) {
  for (int i = 0; i < n; ++i) {
    con[i].dist -= radius_m;
    mju_addToScl3(con[i].pos, con[i].normal, -toward_wheel * radius_m / 2);
  }
}

// One contact for each plane that is touched. Where the contacts of one plane are equally deep, as
// for a wheel that stands upright, their mean is used, so that the wheel turns without scrubbing.
// As the wheel leans, the deepest contact takes over without a jump.
int MergeCoplanar(mjPreContact* con, int n) {
  std::array<bool, kMaxContacts> taken{};
  int merged = 0;
  for (int i = 0; i < n; ++i) {
    if (taken[static_cast<std::size_t>(i)]) continue;
    double deepest = con[i].dist;
    for (int j = i + 1; j < n; ++j)
      if (mju_dot3(con[i].normal, con[j].normal) > kSameNormal)
        deepest = std::min(deepest, con[j].dist);
    mjtNum pos[3] = {0, 0, 0}, normal[3] = {con[i].normal[0], con[i].normal[1], con[i].normal[2]};
    double dist = 0, weights = 0;
    for (int j = i; j < n; ++j) {
      if (taken[static_cast<std::size_t>(j)] || mju_dot3(normal, con[j].normal) <= kSameNormal)
        continue;
      taken[static_cast<std::size_t>(j)] = true;
      const double weight = std::max(0.0, 1 - (con[j].dist - deepest) / kBlend_m);
      weights += weight;
      dist += weight * con[j].dist;
      mju_addToScl3(pos, con[j].pos, weight);
    }
    mjPreContact& out = con[merged++];
    out.dist = dist / weights;
    mju_scl3(out.pos, pos, 1 / weights);
    mju_copy3(out.normal, normal);
  }
  return merged;
}

// Where a tyre lies squarely along an edge or a face, the engine may name either end of the core as
// the one contact. The middle is just as true, and pulls to neither side.
void Centre(const mjData* d, int wheel, mjPreContact* con) {
  constexpr double kSquare = 0.02;  // sine of the angle within which a tyre lies on what it touches
  const mjtNum* mat = d->geom_xmat + 9 * wheel;
  const mjtNum axle[3] = {mat[2], mat[5], mat[8]};
  const double share = 1 - std::abs(mju_dot3(axle, con->normal)) / kSquare;
  if (share <= 0) return;
  mjtNum offset[3];
  mju_sub3(offset, con->pos, d->geom_xpos + 3 * wheel);
  mju_addToScl3(con->pos, axle, -share * mju_dot3(offset, axle));
}

// The axis of the roller at p, along the tangent plane. Seen from the wheel, rollers stand around
// the axle like the threads of a steep screw: each axis is the axle's direction, turned by the
// angle about the radius that points away from the roller.
void SetTangent(const mjData* d, int wheel, double angle_rad, mjPreContact* con) {
  const mjtNum* mat = d->geom_xmat + 9 * wheel;
  const mjtNum axle[3] = {mat[2], mat[5], mat[8]};  // a cylinder's axis is its z
  mjtNum inward[3], along[3], axis[3];
  mju_sub3(inward, d->geom_xpos + 3 * wheel, con->pos);
  mju_addToScl3(inward, axle, -mju_dot3(inward, axle));
  if (mju_normalize3(inward) < mjMINVAL) return;
  mju_cross(along, inward, axle);
  mju_scl3(axis, axle, std::cos(angle_rad));
  mju_addToScl3(axis, along, std::sin(angle_rad));
  mju_addToScl3(axis, con->normal, -mju_dot3(axis, con->normal));
  if (mju_normalize3(axis) > mjMINVAL) mju_copy3(con->tangent, axis);
}

int CollideWheel(const mjModel* m, mjData* d, mjPreContact* con, int g1, int g2, mjtNum margin,
                 mjfCollision original) {
  const bool second = IsPaired(m, g2);
  if (!second && !IsPaired(m, g1)) return original(m, d, con, g1, g2, margin);
  const int wheel = second ? g2 : g1;
  const Rollers rollers = RollersOf(m, wheel);
  int n = original(m, d, con, g1, g2, margin + rollers.radius_m);
  Inflate(con, n, rollers.radius_m, second ? 1 : -1);
  if (n == 1)
    Centre(d, wheel, con);
  else
    n = MergeCoplanar(con, n);
  if (rollers.radius_m <= 0) return n;
  for (int i = 0; i < n; ++i) SetTangent(d, wheel, rollers.angle_rad, con + i);
  return n;
}

// MuJoCo's table holds plain functions: one for each kind of geom that a wheel meets.
template <std::size_t kOther>
int Collide(const mjModel* m, mjData* d, mjPreContact* con, int g1, int g2, mjtNum margin) {
  return CollideWheel(m, d, con, g1, g2, margin, g_original[kOther]);
}

template <std::size_t kOther>
void Install() {
  mjfCollision& entry = kOthers[kOther] < mjGEOM_CYLINDER
                            ? mjCOLLISIONFUNC[kOthers[kOther]][mjGEOM_CYLINDER]
                            : mjCOLLISIONFUNC[mjGEOM_CYLINDER][kOthers[kOther]];
  g_original[kOther] = entry;
  entry = &Collide<kOther>;
}

}  // namespace

Rollers RollersOf(const mjModel* model, int geom) {
  if (model->nuser_geom < 2 || model->geom_type[geom] != mjGEOM_CYLINDER) return {};
  const mjtNum* user = model->geom_user + model->nuser_geom * geom;
  return {user[0], user[1]};
}

Rollers RollersOf(const mjsGeom* geom) {
  int n = 0;
  const double* user = mjs_getDouble(geom->userdata, &n);
  if (n < 2 || geom->type != mjGEOM_CYLINDER) return {};
  return {user[0], user[1]};
}

void InstallWheelCollider() {
  static const bool installed = [] {
    Install<0>();
    Install<1>();
    Install<2>();
    Install<3>();
    return true;
  }();
  static_cast<void>(installed);
}

void InflateWheelBounds(mjModel* model) {
  for (int g = 0; g < model->ngeom; ++g) {
    const double radius_m = RollersOf(model, g).radius_m;
    if (radius_m <= 0) continue;
    model->geom_rbound[g] += radius_m;
    for (int i = 3; i < 6; ++i) model->geom_aabb[6 * g + i] += radius_m;
  }
}

void MarkPaired(mjSpec* spec, mjsGeom* geom) {
  if (geom->type != mjGEOM_CYLINDER) return;
  const Rollers rollers = RollersOf(geom);
  const std::array user = {rollers.radius_m, rollers.angle_rad, kPaired};
  mjs_setDouble(geom->userdata, user.data(), static_cast<int>(user.size()));
  spec->nuser_geom = std::max(spec->nuser_geom, static_cast<int>(user.size()));
}

}  // namespace floorproof
