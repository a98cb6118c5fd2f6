// SPDX-License-Identifier: Apache-2.0
// The parameters that all path followers share, and the limits of the reference path that follow
// from them and from the robot.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/params.h"
#include "controllers/obstacle_gap.h"
#include "controllers/reference_path.h"
#include "env/core/robot_spec.h"

namespace floorproof {

// The share of the robot's accelerations, and of its yaw rate in bends, that a follower plans with.
// What is left corrects errors.
inline constexpr double kPlannedShare = 0.8;
// The wheels reach their speed this much late.
inline constexpr double kWheelLag_s = 0.15;

// The rate at which a robot may turn that has so far to go and is to come to rest there, rad/s, >=
// 0. `min_radps`: where it stood still at less (controllers/creep.h).
inline double TurningRate(double left_rad, double most_radps, double most_radps2,
                          double min_radps = 0) {
  const double stopping_radps =
      StoppingSpeed(std::abs(left_rad), kPlannedShare * most_radps2, kWheelLag_s);
  return std::min(most_radps, std::max(stopping_radps, min_radps));
}

inline double Radians(double deg) { return deg * kPi / 180; }

// How a follower explains the keys that mean something a little different to each.
struct FollowerHelp {
  const char* corner_deg;
  const char* recover_deg;
  double min_recover_deg;  // bound of recover_deg
};

struct FollowerParams {
  double corner_deg = 50;  // 45 deg bends of grid contours are still driven through
  // Each follower states its own defaults for these.
  double corner_cut_m, corner_tolerance_m;
  double heading_tolerance_deg, recover_deg;
  ObstacleGapParams obstacles = {};

  // `own` visits the keys of one follower alone. They come after the first key here.
  void Visit(ParamVisitor& v, const FollowerHelp& help, const std::function<void()>& own);

  ReferenceLimits Limits(const RobotSpec& robot) const;
};

}  // namespace floorproof
