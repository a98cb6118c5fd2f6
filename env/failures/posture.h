// SPDX-License-Identifier: Apache-2.0
// How a body lies in space: from a sample's angles to places of its points.
#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "env/core/motion.h"

namespace floorproof {

using Mat3 = Eigen::Matrix3d;

// R_WB = Rz(yaw) Ry(pitch) Rx(roll).
inline Mat3 Attitude(const Truth& truth) {
  const double cr = std::cos(truth.roll_rad), sr = std::sin(truth.roll_rad),
               cp = std::cos(truth.pitch_rad), sp = std::sin(truth.pitch_rad),
               cy = std::cos(truth.yaw_rad), sy = std::sin(truth.yaw_rad);
  Mat3 R_WB;
  R_WB << cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr,  //
      sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr,      //
      -sp, cp * sr, cp * cr;
  return R_WB;
}

// Towards its low side, seen from above; as long as the sine of its tilt.
inline Vec2 LeanOf(const Mat3& R_WB) { return {R_WB(0, 2), R_WB(1, 2)}; }

}  // namespace floorproof
