// SPDX-License-Identifier: Apache-2.0
#include "env/scene/robot_changes.h"

#include <algorithm>
#include <array>

#include "env/scene/engine.h"
#include "env/scene/robot_limits.h"

namespace floorproof {
namespace {

void Raise(mjsBody* body, double by_m) {
  for (mjsElement* e = mjs_firstChild(body, mjOBJ_GEOM, 0); e; e = mjs_nextChild(body, e, 0))
    mjs_asGeom(e)->pos[2] += by_m;
  for (mjsElement* e = mjs_firstChild(body, mjOBJ_SITE, 0); e; e = mjs_nextChild(body, e, 0))
    mjs_asSite(e)->pos[2] += by_m;
}

void RaiseChassis(mjSpec* spec, const RobotSpec& robot, double by_m) {
  Raise(mjs_findBody(spec, "base"), by_m);
  for (const HingeSpec& hinge : robot.hinges)
    Raise(mjs_getParent(DrivenJoint(spec, hinge.name)->element), by_m);
}

// Wheel and rollers become as large as asked, on the same floor; what is only drawn follows.
void ResizeWheel(mjSpec* spec, const WheelSpec& wheel, double radius_m, double roller_m) {
  mjsBody* body = mjs_getParent(DrivenJoint(spec, wheel.name)->element);
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

constexpr int kVmax = 7;  // of a dcmotor's gain parameters

}  // namespace

double DriverVoltage(const mjModel* model, int actuator) {
  return model->actuator_gainprm[mjNGAIN * actuator + kVmax];
}

void SetDriverVoltage(mjModel* model, int actuator, double voltage_v) {
  constexpr double kLeast_v = 1e-6;  // MuJoCo takes 0 for no limit
  model->actuator_gainprm[mjNGAIN * actuator + kVmax] = std::max(voltage_v, kLeast_v);
}

std::optional<VelocityDrive> DriveOf(const mjModel* model, int actuator) {
  constexpr int kPosition = 4, kVelocity = 6;  // gains of the driver
  const mjtNum* gain = model->actuator_gainprm + mjNGAIN * actuator;
  if (gain[kPosition] != 0 || gain[kVelocity] == 0) return std::nullopt;
  const double most_nm =
      model->actuator_forcelimited[actuator] ? model->actuator_forcerange[2 * actuator + 1] : 0;
  return VelocityDrive{gain[0], gain[1], gain[kVelocity], DriverVoltage(model, actuator), most_nm};
}

void ScaleMass(mjsBody* body, double factor) {
  for (mjsElement* e = mjs_firstChild(body, mjOBJ_GEOM, 0); e; e = mjs_nextChild(body, e, 0)) {
    mjs_asGeom(e)->mass *= factor;  // NaN where the density rules
    mjs_asGeom(e)->density *= factor;
  }
  if (!body->explicitinertial) return;
  body->mass *= factor;
  for (double& i : body->inertia) i *= factor;
  for (double& i : body->fullinertia) i *= factor;
}

void RobotChanges::Visit(ParamVisitor& v) {
  v("mass_kg", mass_kg, kMass_kg, "total mass (kg); none: the model's");
  v("clearance_m", clearance_m, kClearance_m, "belly above the floor (m); none: the model's");
  v("wheel_radius_m", wheel_radius_m, kWheelRadius_m,
    "of the driven wheels, rollers included (m); none: the model's");
  v("roller_radius_m", roller_radius_m, kWheelRadius_m,
    "of a Mecanum wheel's rollers (m); none: the model's");
  v("shape", shape, {}, "of a reconfigurable robot, at the start; empty: the model's");
}

bool ChangeRobot(mjSpec* spec, const RobotSpec& robot, const RobotChanges& changes) {
  const bool wheels = changes.wheel_radius_m || changes.roller_radius_m;
  if (changes.mass_kg)
    for (mjsElement* e = mjs_firstElement(spec, mjOBJ_BODY); e; e = mjs_nextElement(spec, e))
      ScaleMass(mjs_asBody(e), *changes.mass_kg / robot.mass_kg);
  if (changes.clearance_m) RaiseChassis(spec, robot, *changes.clearance_m - robot.clearance_m);
  if (wheels) ResizeWheels(spec, robot, changes);
  if (changes.battery_v)
    for (mjsElement* e = mjs_firstElement(spec, mjOBJ_ACTUATOR); e; e = mjs_nextElement(spec, e))
      mjs_asActuator(e)->gainprm[kVmax] = *changes.battery_v;
  return changes.mass_kg || changes.clearance_m || wheels || changes.battery_v;
}

}  // namespace floorproof
