// SPDX-License-Identifier: Apache-2.0
// A robot that drives straight on at a held speed, in closed form.
#pragma once

#include "validate/rig.h"

namespace floorproof {

// What the motors draw, and the speed they hold.
struct SteadyDrive {
  double power_w = 0, speed_mps = 0;
};
// n wheels of radius r are asked for u = v / r and meet this force beside the sliding casters'
// friction, N: each motor gives T = T_f + b omega + F r / n = k (u - omega) and draws
// T omega + R (T / K)^2. Where that is negative nothing comes back: the power is 0.
SteadyDrive DriveSteadily(const Rig& truth, double speed_mps, double force_n);

double Weight(const RobotSpec& robot);  // N
double MotorsPower(const Rig& rig);     // that the motors draw now, W

}  // namespace floorproof
