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

// A linear spring without preload: slack where the wheel has gone down by its travel, and as much
// again to its stop upwards.
struct WheelSpring {
  double stiffness_npm = 0, damping_nspm = 0, travel_m = 0;
};

// One a driven wheel. `share` of the weight, above 0 to 1, is carried by them; all of it where
// there are no casters.
std::vector<WheelSpring> WheelSprings(const UrdfRobot& robot, double share, double travel_m);

}  // namespace floorproof
