// SPDX-License-Identifier: Apache-2.0
// What is other than built while an episode runs: a fault's effect, or a model made wrong on
// purpose. Plain data; the simulation and the sensors apply it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "env/geometry/geometry.h"

namespace floorproof {

struct Alterations {
  // By driven wheel, RobotSpec's order; empty: as built.
  // Share of its torque that the motor gives; 0: it turns freely.
  std::vector<double> wheel_torque = {};
  // Of Mecanum wheels. 0: the rollers run freely; 1: they are blocked.
  std::vector<double> roller_drag = {};
  // Speed that the motor's driver holds whatever it is told, rad/s; none: it does as it is told.
  std::vector<std::optional<double>> wheel_stuck_radps = {};
  // The most friction that the wheel finds on floors and hazards, its rollers included; none: as
  // built.
  std::vector<std::optional<double>> wheel_friction = {};

  // Factors on what was built.
  double floor_friction = 1;    // of the floor, and of hazards that state none
  double motor_resistance = 1;  // of every motor's windings
  double battery_voltage = 1;   // > 0
  double hotel_load = 1;        // what all but the motors draws

  double payload_kg = 0;
  Vec3 payload_p_B = Vec3::Zero();  // its centre, in the base's frame

  std::vector<std::string> silent_sensors = {};  // by name: they tell nothing
  // The bumper says that it is pressed there, from the body's x, counter-clockwise; none: it tells
  // what there is.
  std::optional<double> bump_stuck_rad = {};

  // The robot is taken up and set down elsewhere, once, as this begins: from its place to there, in
  // its own axes.
  std::optional<Pose2> carried = {};

  bool operator==(const Alterations&) const = default;
};

}  // namespace floorproof
