// SPDX-License-Identifier: Apache-2.0
#include "env/scene/robot_changes.h"

#include <array>

namespace floorproof {
namespace {

template <class Element>
void ForEach(mjSpec* spec, mjtObj type, Element* (*cast)(mjsElement*),
             void (*apply)(Element*, double), double value) {
  for (mjsElement* e = mjs_firstElement(spec, type); e; e = mjs_nextElement(spec, e))
    apply(cast(e), value);
}

void ScaleMass(mjSpec* spec, double factor) {
  ForEach<mjsGeom>(
      spec, mjOBJ_GEOM, mjs_asGeom,
      [](mjsGeom* geom, double f) {
        geom->mass *= f;  // NaN where the density rules
        geom->density *= f;
      },
      factor);
  ForEach<mjsBody>(
      spec, mjOBJ_BODY, mjs_asBody,
      [](mjsBody* body, double f) {
        if (!body->explicitinertial) return;
        body->mass *= f;
        for (double& i : body->inertia) i *= f;
        for (double& i : body->fullinertia) i *= f;
      },
      factor);
}

// The joint that the motor of this name drives.
mjsElement* JointOf(mjSpec* spec, const std::string& motor) {
  mjsElement* actuator = mjs_findElement(spec, mjOBJ_ACTUATOR, motor.c_str());
  return mjs_findElement(spec, mjOBJ_JOINT, mjs_getString(mjs_asActuator(actuator)->target));
}

void Raise(mjsBody* body, double by_m) {
  for (mjsElement* e = mjs_firstChild(body, mjOBJ_GEOM, 0); e; e = mjs_nextChild(body, e, 0))
    mjs_asGeom(e)->pos[2] += by_m;
  for (mjsElement* e = mjs_firstChild(body, mjOBJ_SITE, 0); e; e = mjs_nextChild(body, e, 0))
    mjs_asSite(e)->pos[2] += by_m;
}

void RaiseChassis(mjSpec* spec, const RobotSpec& robot, double by_m) {
  Raise(mjs_findBody(spec, "base"), by_m);
  for (const HingeSpec& hinge : robot.hinges) Raise(mjs_getParent(JointOf(spec, hinge.name)), by_m);
}

// Wheel and rollers become as large as asked, on the same floor; what is only drawn follows.
void ResizeWheel(mjSpec* spec, const WheelSpec& wheel, double radius_m, double roller_m) {
  mjsBody* body = mjs_getParent(JointOf(spec, wheel.name));
  body->pos[2] += radius_m - wheel.radius_m;
  const double whole = radius_m / wheel.radius_m;
  const double core = (radius_m - roller_m) / (wheel.radius_m - wheel.roller_radius_m);
  for (mjsElement* e = mjs_firstChild(body, mjOBJ_GEOM, 0); e; e = mjs_nextChild(body, e, 0)) {
    mjsGeom* geom = mjs_asGeom(e);
    if (geom->contype != 0 || geom->conaffinity != 0) {
      geom->size[0] = radius_m - roller_m;
      if (roller_m > 0) {
        const std::array user = {roller_m, wheel.roller_angle_rad};
        mjs_setDouble(geom->userdata, user.data(), static_cast<int>(user.size()));
      }
    } else if (geom->type == mjGEOM_ELLIPSOID && roller_m > 0) {  // a roller
      for (double& p : geom->pos) p *= core;
      for (int k = 0; k < 2; ++k) geom->size[k] *= roller_m / wheel.roller_radius_m;
      geom->size[2] *= whole;
    } else {
      geom->size[0] *= whole;
    }
  }
}

void ResizeWheels(mjSpec* spec, const RobotSpec& robot, const RobotChanges& changes) {
  const auto refuse = [&](const char* key, double value, const char* rule) {
    throw InputError({robot.model_file, 0}, key, FormatDouble(value), rule);
  };
  for (const WheelSpec& wheel : robot.wheels) {
    if (changes.roller_radius_m && wheel.roller_radius_m == 0)
      refuse("roller_radius_m", *changes.roller_radius_m, "the robot's wheels have no rollers");
    const double radius_m = changes.wheel_radius_m.value_or(wheel.radius_m);
    const double roller_m = changes.roller_radius_m.value_or(wheel.roller_radius_m);
    if (!(roller_m < 0.9 * radius_m))
      refuse(changes.roller_radius_m ? "roller_radius_m" : "wheel_radius_m",
             changes.roller_radius_m ? roller_m : radius_m,
             "rollers must be smaller than 0.9 of the wheel's radius");
    ResizeWheel(spec, wheel, radius_m, roller_m);
  }
}

}  // namespace

void RobotChanges::Visit(ParamVisitor& v) {
  v("mass_kg", mass_kg, Positive(), "total mass (kg); none: the model's");
  v("clearance_m", clearance_m, Positive(), "belly above the floor (m); none: the model's");
  v("wheel_radius_m", wheel_radius_m, Positive(),
    "of the driven wheels, rollers included (m); none: the model's");
  v("roller_radius_m", roller_radius_m, Positive(),
    "of a Mecanum wheel's rollers (m); none: the model's");
  v("shape", shape, {}, "of a reconfigurable robot, at the start; empty: the model's");
}

bool ChangeRobot(mjSpec* spec, const RobotSpec& robot, const RobotChanges& changes) {
  const bool wheels = changes.wheel_radius_m || changes.roller_radius_m;
  if (changes.mass_kg) ScaleMass(spec, *changes.mass_kg / robot.mass_kg);
  if (changes.clearance_m) RaiseChassis(spec, robot, *changes.clearance_m - robot.clearance_m);
  if (wheels) ResizeWheels(spec, robot, changes);
  return changes.mass_kg || changes.clearance_m || wheels;
}

}  // namespace floorproof
