// SPDX-License-Identifier: Apache-2.0
// Lengths of a robot by which hazards are large or small for it.
#pragma once

#include <string_view>

#include "env/core/robot_spec.h"

namespace floorproof {

// The radius of its smallest driven wheel: what is as wide swallows it.
double WheelScale(const RobotSpec& robot);
// An edge that the robot surely does not cross: four fifths of its wheels' radius or of its belly's
// clearance, whichever is less; more where measured limits of this kind say that it crosses two
// fifths of that.
double EdgeScale(const RobotSpec& robot, std::string_view kind);

}  // namespace floorproof
