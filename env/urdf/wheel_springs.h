// SPDX-License-Identifier: Apache-2.0
// Springs under driven wheels, which a URDF cannot state: from the share of the weight that they
// carry and how far they give.
//
// Springs of one stiffness in a plate share its weight as statics says, for any number of wheels:
// F_i = F / n + F (c - m) (q_i - m) / sum (q - m)^2 along each axis, with F the weight on them, c
// the centre of mass, q_i the wheels' places and m their mean. What casters carry besides is taken
// to be shared alike, left and right, before and behind.
#pragma once

#include <vector>

#include "env/urdf/urdf_robot.h"

namespace floorproof {

// A linear spring. The wheel goes down by its travel, and as much up, to stops. Without preload the
// spring is slack at the lower stop.
struct WheelSpring {
  double stiffness_npm = 0, damping_nspm = 0, travel_m = 0;
  double slack_m = 0;  // height of the wheel at which the spring is slack; at rest it is 0
};

struct SpringAnswers {
  double share = 0;     // of the weight, above 0 to 1; all of it where there are no casters
  double travel_m = 0;  // one way
  double preload = 0;   // a spring's force at the lower stop, as a share of its load at rest
};

// One a driven wheel.
std::vector<WheelSpring> WheelSprings(const UrdfRobot& robot, const SpringAnswers& answers);

}  // namespace floorproof
