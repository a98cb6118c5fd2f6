// SPDX-License-Identifier: Apache-2.0
// What a scenario may change of a robot's model.
#pragma once

#include <mujoco/mujoco.h>

#include <optional>

#include "base/params.h"
#include "env/core/robot_spec.h"

namespace floorproof {

struct RobotChanges {
  std::optional<double> mass_kg = {};      // all masses and inertias scaled to this total
  std::optional<double> clearance_m = {};  // the body raised or lowered over its wheels
  std::optional<double> wheel_radius_m =
      {};  // of the driven wheels, rollers included; the body stays
  std::optional<double> roller_radius_m = {};  // of Mecanum wheels
  std::string shape = {};  // of a reconfigurable robot, at the start; empty: the model's own
  // Of the battery, hence of every motor's driver; a scenario's `battery.voltage_v`, so Visit
  // passes it over.
  std::optional<double> battery_v = {};

  void Visit(ParamVisitor& v);
};

// The most that a dcmotor's driver gives, V; 0: no limit. Set to no less than a microvolt.
double DriverVoltage(const mjModel* model, int actuator);
void SetDriverVoltage(mjModel* model, int actuator, double voltage_v);
// The motor of a dcmotor with its driver, as the model has it now; none: its driver holds an angle,
// or no speed.
std::optional<VelocityDrive> DriveOf(const mjModel* model, int actuator);

// Scales the masses and inertias of the body and of its own geoms.
void ScaleMass(mjsBody* body, double factor);

// Changes `spec`, from which `robot` was read; false when there was nothing to change. Throws
// InputError naming the robot's file when the wheels cannot be as asked.
bool ChangeRobot(mjSpec* spec, const RobotSpec& robot, const RobotChanges& changes);

}  // namespace floorproof
