// SPDX-License-Identifier: Apache-2.0
// Mecanum wheels with rollers that are bodies: the cross-check of the ideal ones
// (env/scene/wheel_collider.h), and what the stock MuJoCo can roll.
//
// Each wheel becomes a hub on the motor's hinge, with kRollers rollers that turn freely on hinges
// of their own, with the same radius R, roller radius r and angle. A roller is an ellipsoid of
// revolution: it has no facets and one contact. Its semi-axis makes the wheel as high where one
// roller hands over to the next as at the middle of one; in between the wheel is 0.05 mm higher
// (htetro). Rollers meet floor and hazards with the friction and softness of what they meet, the
// same in all directions, by pairs as ideal wheels do (BuildScene). They never meet each other or
// the body. Three things differ from the ideal wheel. A roller that is not lowest stands aslant,
// which takes up to 1 - sin(x) / x with x = pi / kRollers, 2.6 %, off the sideways motion. The
// contact wanders from one side of the tyre to the other. The end of an ellipsoid is more pointed
// than the rim of a rounded core.
#pragma once

#include <string>

#include "env/core/robot_spec.h"
#include "env/scene/robot_model.h"

namespace floorproof {

constexpr int kRollers = 8;  // of a wheel

bool HasMecanumWheels(const RobotSpec& robot);

// What the names of the rollers' geoms of this wheel begin with; a number follows.
std::string RollerPrefix(const std::string& wheel);

// Half the length of a roller. With x = pi / kRollers, R and r the radii of wheel and roller and
// alpha the angle, the wheel's height over the floor, turned by x from a roller's middle, is
//   (R - r) cos x + sqrt(r^2 + (a^2 - r^2) sin^2 alpha sin^2 x)
// by the support function of an ellipsoid; it is R for this a.
double RollerHalfLength(const WheelSpec& wheel);

// The robot with rollers on its Mecanum wheels; as it is where it has none. The RobotSpec stays:
// planners, trackers and detectors see the same robot. Half of a wheel's mass goes to its rollers.
// Ellipsoids that a wheel's body only draws are taken for its rollers and removed.
RobotModel WithRollerWheels(const RobotModel& robot);

}  // namespace floorproof
