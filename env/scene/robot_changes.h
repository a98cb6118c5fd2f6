// SPDX-License-Identifier: Apache-2.0
// What a scenario may change of a robot's model.
#pragma once

#include <mujoco/mujoco.h>

#include <optional>

#include "env/core/params.h"
#include "env/core/robot_spec.h"

namespace floorproof {

struct RobotChanges {
  std::optional<double> mass_kg = {};      // all masses and inertias scaled to this total
  std::optional<double> clearance_m = {};  // the body raised or lowered over its wheels
  std::optional<double> wheel_radius_m =
      {};  // of the driven wheels, rollers included; the body stays
  std::optional<double> roller_radius_m = {};  // of Mecanum wheels
  std::string shape = {};  // of a reconfigurable robot, at the start; empty: the model's own

  void Visit(ParamVisitor& v);
};

// Changes `spec`, from which `robot` was read; false when there was nothing to change. Throws
// InputError naming the robot's file when the wheels cannot be as asked.
bool ChangeRobot(mjSpec* spec, const RobotSpec& robot, const RobotChanges& changes);

}  // namespace floorproof
