// SPDX-License-Identifier: Apache-2.0
#include "env/scene/lock_blocks.h"

#include <cmath>

#include "env/core/blocks.h"
#include "env/scene/engine.h"

namespace floorproof {
namespace {

// Turns the hinge's body about its axis, by `turn_rad` counterclockwise, then takes the hinge out.
void Lock(mjSpec* spec, const std::string& name, double turn_rad) {
  mjsJoint* joint = DrivenJoint(spec, name);
  mjsBody* body = mjs_getParent(joint->element);
  // ReadRobot has seen to it that the body stands in its parent's frame.
  const double c = std::cos(turn_rad), s = std::sin(turn_rad);
  const double x = joint->pos[0], y = joint->pos[1];
  body->pos[0] = x - (c * x - s * y);
  body->pos[1] = y - (s * x + c * y);
  body->quat[0] = std::cos(turn_rad / 2);
  body->quat[3] = std::sin(turn_rad / 2);
  mjs_delete(spec, mjs_findElement(spec, mjOBJ_ACTUATOR, name.c_str()));
  mjs_delete(spec, joint->element);
}

void Shift(double* pos, const Vec2& by) {
  pos[0] += by.x();
  pos[1] += by.y();
}

// Everything that hangs on the body itself.
void ShiftContents(mjsBody* body, const Vec2& by) {
  for (mjsElement* e = mjs_firstChild(body, mjOBJ_GEOM, 0); e; e = mjs_nextChild(body, e, 0)) {
    mjsGeom* geom = mjs_asGeom(e);
    if (std::isfinite(geom->fromto[0])) {
      Shift(geom->fromto, by);
      Shift(geom->fromto + 3, by);
    }
    Shift(geom->pos, by);
  }
  for (mjsElement* e = mjs_firstChild(body, mjOBJ_SITE, 0); e; e = mjs_nextChild(body, e, 0))
    Shift(mjs_asSite(e)->pos, by);
  for (mjsElement* e = mjs_firstChild(body, mjOBJ_BODY, 0); e; e = mjs_nextChild(body, e, 0))
    Shift(mjs_asBody(e)->pos, by);
}

}  // namespace

void LockBlocks(mjSpec* spec, const RobotSpec& robot, const ShapeSpec& shape) {
  const BlockMotions motions = MoveBlocks(robot.blocks, robot.hinges, AtRest(shape.hinge_rad));
  for (std::size_t h = 0; h < robot.hinges.size(); ++h) {
    const HingeSpec& hinge = robot.hinges[h];
    Lock(spec, hinge.name, hinge.sign * (shape.hinge_rad[h] - hinge.model_rad));
  }
  ShiftContents(mjs_findBody(spec, "base"), -motions.p_RB);
  mjs_delete(spec, mjs_findElement(spec, mjOBJ_TEXT, "hinges"));
  std::string names;
  for (std::size_t k = 1; k < robot.blocks.size(); ++k) names += robot.blocks[k].name + " ";
  mjsText* text = mjs_addText(spec);
  mjs_setName(text->element, kLockedBlocks);
  mjs_setString(text->data, names.c_str());
}

}  // namespace floorproof
