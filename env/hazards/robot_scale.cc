// SPDX-License-Identifier: Apache-2.0
#include "env/hazards/robot_scale.h"

#include <algorithm>
#include <limits>

namespace floorproof {

double WheelScale(const RobotSpec& robot) {
  double least_m = std::numeric_limits<double>::infinity();
  for (const WheelSpec& wheel : robot.wheels) least_m = std::min(least_m, wheel.radius_m);
  return least_m;
}

double EdgeScale(const RobotSpec& robot, std::string_view kind) {
  constexpr double kOfWheel = 0.8, kOfLimit = 2.5;
  const double scale_m = kOfWheel * std::min(WheelScale(robot), robot.clearance_m);
  if (robot.measured.limits.empty()) return scale_m;
  const auto limit_m = LimitOn(robot.measured, kind, robot.measured.frictions.back());
  return std::max(scale_m, kOfLimit * limit_m.value_or(0));
}

}  // namespace floorproof
