// SPDX-License-Identifier: Apache-2.0
// Which way up is, by an IMU, while the robot speeds up and its floor tilts.
#pragma once

#include <Eigen/Geometry>

#include "env/geometry/geometry.h"

namespace floorproof {

// A complementary filter: the gyroscope turns what is up, and the accelerometer, which measures
// gravity and the robot's own acceleration together, draws it back slowly. So a ramp is followed at
// once, and a jolt is not taken for a slope.
class Upwards {
 public:
  void Reset() { up_B_.setZero(); }
  // One period; returns the unit vector upwards in the body frame.
  const Vec3& Update(const Vec3& gyro_radps, const Vec3& accel_mps2, double dt_s) {
    constexpr double kDrift_s = 10;  // in which a gyroscope's offset does little
    if (accel_mps2.norm() == 0) return up_B_;
    const Vec3 felt_B = accel_mps2.normalized();
    if (up_B_.isZero(0)) return up_B_ = felt_B;
    up_B_ += dt_s * (up_B_.cross(gyro_radps) + (felt_B - up_B_) / kDrift_s);
    up_B_.normalize();
    return up_B_;
  }

 private:
  Vec3 up_B_ = Vec3::Zero();
};

}  // namespace floorproof
