// SPDX-License-Identifier: Apache-2.0
// The figures of a robot's model that its URDF does not state: answered, told by the URDF's own
// limits, or guessed, each with its reason.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "env/urdf/urdf_robot.h"
#include "env/urdf/wheel_springs.h"

namespace floorproof {

struct Figure {
  double value = 0;
  std::string why;  // "given", or what it goes by; a guess begins with "guess: "
};

struct Choice {
  std::string value;
  std::string why;  // as Figure's
};

struct RobotGuesses {
  Figure no_load_radps, stall_nm;  // of each motor, at the wheel
  std::optional<double> peak_nm;   // where its driver limits the current
  Figure friction_nm;              // dry, in a wheel's bearing
  Figure armature_kgm2, driver_gain;
  Figure cruise_mps, max_speed_mps, max_accel_mps2, max_yaw_rate_radps, max_yaw_accel_radps2;
  Figure tool_width_m, step_m, hotel_load_w;
  Choice standstill;                 // Name(Standstill)
  Choice tyre, caster;               // Name(TyreMaterial)
  std::vector<WheelSpring> springs;  // one a driven wheel, or none
  Figure spring_travel_m, spring_preload;
};

RobotGuesses GuessRobot(const UrdfRobot& robot, const UrdfAnswers& answers);

// A line for each guess that a key answers.
std::vector<std::string> Questions(const RobotGuesses& guesses);

}  // namespace floorproof
