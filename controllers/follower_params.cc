// SPDX-License-Identifier: Apache-2.0
#include "controllers/follower_params.h"

namespace floorproof {

void FollowerParams::Visit(ParamVisitor& v, const FollowerHelp& help,
                           const std::function<void()>& own) {
  v("corner_deg", corner_deg, Between(5, 90), help.corner_deg);
  own();
  v("corner_cut_m", corner_cut_m, Between(0.001, 0.5),
    "how far bends may be cut that are driven through: slower is nearer");
  v("corner_tolerance_m", corner_tolerance_m, Between(0.002, 0.5),
    "a corner or the last waypoint is reached within this along the way");
  v("heading_tolerance_deg", heading_tolerance_deg, Between(0.2, 20),
    "a turn on the spot ends within this");
  v("recover_deg", recover_deg, Between(help.min_recover_deg, 150), help.recover_deg);
  obstacles.Visit(v);
}

ReferenceLimits FollowerParams::Limits(const RobotSpec& robot) const {
  ReferenceLimits limits;
  limits.corner_rad = Radians(corner_deg);
  limits.cut_m = corner_cut_m;
  limits.yaw_rate_radps = kPlannedShare * robot.max_yaw_rate_radps;
  limits.yaw_accel_radps2 = robot.max_yaw_accel_radps2;
  limits.decel_mps2 = kPlannedShare * robot.max_accel_mps2;
  limits.lag_s = kWheelLag_s;
  limits.cruise_mps = robot.cruise_mps;
  limits.max_speed_mps = robot.max_speed_mps;
  return limits;
}

}  // namespace floorproof
