// SPDX-License-Identifier: Apache-2.0
// A low box on four plain, driven wheels: statically determinate, so that closed forms are exact.
#pragma once

#include "validate/rig.h"

namespace floorproof {

struct Cart {
  double wheel_radius_m = 0.04;
  double axle_x_m = 0.20;  // of the front axle; the rear one's is minus that
  double com_x_m = 0;      // of body and wheels together
};

// Named "cart"; its wheels hold the speeds commanded.
RobotModel MakeCart(const Cart& cart);

}  // namespace floorproof
