// SPDX-License-Identifier: Apache-2.0
// How large, heavy, fast and many-parted a robot may be: as far as the program is made for floor
// robots, and grids and plans of their width stay of a size that can be held.
#pragma once

#include <mujoco/mujoco.h>

#include <string>

#include "base/params.h"

namespace floorproof {

inline constexpr double kMaxReach_m = 10;  // from the base's origin to any point of the robot

// By the key that states it.
inline constexpr Bounds kWheelRadius_m = {0.001, 2, false};
inline constexpr Bounds kMass_kg = {0.01, 10'000, false};
inline constexpr Bounds kClearance_m = {0.0001, 2, false};
inline constexpr Bounds kToolWidth_m = {0.01, 2 * kMaxReach_m, false};
inline constexpr Bounds kStep_m = {0, 1, false};
inline constexpr Bounds kSpeed_mps = {0.001, 20, false};
inline constexpr Bounds kAcceleration_mps2 = {0.001, 100, false};
inline constexpr Bounds kYawRate_radps = {0.001, 100, false};
inline constexpr Bounds kYawAcceleration_radps2 = {0.001, 1000, false};
inline constexpr Bounds kPower_w = {0, 100'000, false};
inline constexpr Bounds kMotorVoltage_v = {0, 10'000, false};
inline constexpr Bounds kMotorSpeed_radps = {0.001, 10'000, false};
inline constexpr Bounds kMotorTorque_nm = {1e-6, 100'000, false};
inline constexpr Bounds kDwell_s = {0, 100'000, false};

// Throws InputError naming the file and the part where the compiled model has too many parts, or
// one that is too large, too far from the base or too heavy. To be asked before it is simulated.
void RefuseBeyondLimits(const mjModel* model, const std::string& file);

}  // namespace floorproof
