// SPDX-License-Identifier: Apache-2.0
// How far the robot leans, by its accelerometer alone, smoothed: enough to know that it stands on
// something.
#pragma once

#include <algorithm>
#include <cmath>

#include "controllers/monitors/monitor.h"

namespace floorproof {

class LeanAngle {
 public:
  void Reset() {
    ahead_.Reset();
    aside_.Reset();
  }
  // One period, rad; 0 without an IMU.
  double Update(const MonitorReadings& now) {
    constexpr double kSmooth_s = 0.2;
    const Vec3 up = now.has_imu ? now.accel_mps2.normalized() : Vec3::UnitZ();
    return std::asin(std::min(1.0, std::hypot(ahead_.Update(up.x(), now.dt_s, kSmooth_s),
                                              aside_.Update(up.y(), now.dt_s, kSmooth_s))));
  }

 private:
  LowPass ahead_, aside_;
};

}  // namespace floorproof
