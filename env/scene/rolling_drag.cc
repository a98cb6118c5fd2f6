// SPDX-License-Identifier: Apache-2.0
#include "env/scene/rolling_drag.h"

#include <algorithm>

#include "env/scene/robot_model.h"

namespace floorproof {
namespace {

bool Turns(mjsBody* body) {
  for (mjsElement* e = mjs_firstChild(body, mjOBJ_JOINT, 0); e; e = mjs_nextChild(body, e, 0))
    if (mjs_asJoint(e)->type == mjJNT_HINGE || mjs_asJoint(e)->type == mjJNT_BALL) return true;
  return false;
}

}  // namespace

std::vector<Foot> FeetOf(mjSpec* spec, const RobotSpec& robot) {
  std::vector<Foot> feet;
  const mjsBody* world = mjs_findBody(spec, "world");
  for (mjsElement* e = mjs_firstElement(spec, mjOBJ_GEOM); e; e = mjs_nextElement(spec, e)) {
    mjsGeom* geom = mjs_asGeom(e);
    mjsBody* body = mjs_getParent(e);
    const bool touches = geom->contype != 0 || geom->conaffinity != 0;
    if (!touches || body == world || IsChassis(body, robot)) continue;
    const bool round = geom->type == mjGEOM_CYLINDER || geom->type == mjGEOM_SPHERE ||
                       geom->type == mjGEOM_CAPSULE;
    feet.push_back({geom, round && Turns(body) ? geom->size[0] : 0});
  }
  return feet;
}

void PairFoot(mjSpec* spec, const Foot& foot, const mjsGeom* ground, double drag) {
  mjsPair* pair = mjs_addPair(spec, nullptr);
  mjs_setString(pair->geomname1, mjs_getString(mjs_getName(foot.geom->element)));
  mjs_setString(pair->geomname2, mjs_getString(mjs_getName(ground->element)));
  // As the engine would choose: what has the higher priority rules.
  const mjsGeom* ruler = foot.geom->priority > ground->priority ? foot.geom : ground;
  const bool rolls = foot.radius_m > 0;
  pair->condim = rolls ? 6 : 3;
  const double slide = ruler->friction[0] + (rolls ? 0 : drag), roll = drag * foot.radius_m;
  const double friction[5] = {slide, slide, 0, roll, roll};
  std::copy(std::begin(friction), std::end(friction), pair->friction);
  std::copy(std::begin(ruler->solref), std::end(ruler->solref), pair->solref);
  std::copy(std::begin(ruler->solimp), std::end(ruler->solimp), pair->solimp);
}

}  // namespace floorproof
