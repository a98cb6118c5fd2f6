// SPDX-License-Identifier: Apache-2.0
#include "env/scene/tyre.h"

#include <algorithm>
#include <cmath>

#include "env/scene/engine.h"

namespace floorproof {
namespace {

// Whether the wheels stand on several parallel axles.
bool Scrub(const RobotSpec& robot) {
  constexpr double kOneAxle_m = 1e-3, kParallel_rad = 1e-3;
  const WheelSpec& first = robot.wheels.front();
  const Vec2 ahead(std::cos(first.yaw_rad), std::sin(first.yaw_rad));
  double farthest_m = 0;
  for (const WheelSpec& wheel : robot.wheels) {
    if (wheel.roller_radius_m > 0) return false;
    if (std::abs(WrapAngle(wheel.yaw_rad - first.yaw_rad)) > kParallel_rad) return false;
    const Vec2 from_first = (wheel.p_BW - first.p_BW).head<2>();
    farthest_m = std::max(farthest_m, std::abs(from_first.dot(ahead)));
  }
  return farthest_m > kOneAxle_m;
}

}  // namespace

std::vector<mjsGeom*> ScrubbingTyres(mjSpec* spec, const RobotSpec& robot) {
  if (robot.wheels.size() < 3 || !Scrub(robot)) return {};
  std::vector<mjsGeom*> tyres;
  for (const WheelSpec& wheel : robot.wheels) {
    mjsBody* body = mjs_getParent(DrivenJoint(spec, wheel.name)->element);
    for (mjsElement* e = mjs_firstChild(body, mjOBJ_GEOM, 0); e; e = mjs_nextChild(body, e, 0))
      if (mjs_asGeom(e)->type == mjGEOM_CYLINDER && mjs_asGeom(e)->conaffinity != 0)
        tyres.push_back(mjs_asGeom(e));
  }
  return tyres;
}

void PairTyre(mjSpec* spec, const mjsGeom* tyre, const mjsGeom* other, double drag) {
  constexpr double kNormal_s = 0.02, kFriction_s = 0.06;  // time constants
  constexpr mjtNum kSolimp[] = {0.3, 0.9, 0.0005};
  mjsPair* pair = mjs_addPair(spec, nullptr);
  mjs_setString(pair->geomname1, mjs_getString(mjs_getName(tyre->element)));
  mjs_setString(pair->geomname2, mjs_getString(mjs_getName(other->element)));
  pair->condim = drag > 0 ? 6 : 3;
  const double mu = other->friction[0], roll = drag * tyre->size[0];
  const double friction[5] = {mu, mu, 0, roll, roll};
  std::copy(std::begin(friction), std::end(friction), pair->friction);
  std::copy(std::begin(other->solref), std::end(other->solref), pair->solref);
  std::copy(std::begin(other->solimp), std::end(other->solimp), pair->solimp);
  if (other->solref[1] < 1) return;
  pair->solref[0] = kNormal_s;
  std::copy(std::begin(kSolimp), std::end(kSolimp), pair->solimp);
  pair->solreffriction[0] = kFriction_s;
  pair->solreffriction[1] = 1;
}

}  // namespace floorproof
