// SPDX-License-Identifier: Apache-2.0
// A low box on four plain, driven wheels: statically determinate, so that closed forms are exact.
#pragma once

#include <optional>

#include "validate/rig.h"

namespace floorproof {

struct Cart {
  double wheel_radius_m = 0.04;
  double axle_x_m = 0.20;  // of the front axle; the rear one's is minus that
  double com_x_m = 0;      // of body and wheels together
  double motor_nm = 3;     // of each
  double nose_m = 0;       // how far a wide box without mass reaches ahead; 0: there is none
  double clearance_m = 0;  // from the floor to that box
  std::optional<double> tyre_npmm = {};  // none: hard rubber's
  std::optional<double> tyre_damping_ratio = {};
};

inline constexpr double kNoseHalfWidth_m = 0.14;

// Named "cart"; its wheels hold the speeds commanded.
RobotModel MakeCart(const Cart& cart);

// From now on its motors give nothing and its bearings do not rub; it rolls at this speed, on a
// floor of this height.
void Coast(Rig& rig, const Cart& cart, double speed_mps, double floor_m = 0);

}  // namespace floorproof
