// SPDX-License-Identifier: Apache-2.0
// The parts of a RobotSpec that take more than a line to read (spec_reader.h). Each fills in its
// own fields and throws InputError that names the file; in this order.
#pragma once

#include "env/core/robot_spec.h"
#include "env/scene/compiled_robot.h"

namespace floorproof {

struct Motor {
  double no_load_radps, stall_nm;  // at the joint
};
// Of actuator a, called `name`.
Motor ReadMotor(const CompiledRobot& compiled, int a, const std::string& name);

// `hinges`, named under <custom>; their bodies become blocks of `compiled`.
void ReadHinges(CompiledRobot& compiled, RobotSpec& robot);

// `wheels`: all actuators but the hinges' and those that `steering` names.
void ReadWheels(const CompiledRobot& compiled, RobotSpec& robot);

// `steering`, named under <custom>, and `turn_radius_m`; the wheels are known. The wheels that do
// not steer must roll on an axle at x = 0.
void ReadSteering(const CompiledRobot& compiled, RobotSpec& robot);

// `blocks`, `shapes` and `static_tip_rad`, the last from wheels and mass. A robot without hinges
// has neither blocks nor shapes.
void ReadShapes(const CompiledRobot& compiled, RobotSpec& robot);

// `measured`: the limits under <custom>, where there are such.
void ReadMeasuredLimits(const CompiledRobot& compiled, RobotSpec& robot);

}  // namespace floorproof
