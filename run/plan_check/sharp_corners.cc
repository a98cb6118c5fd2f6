// SPDX-License-Identifier: Apache-2.0
#include "run/plan_check/sharp_corners.h"

#include <cmath>

namespace floorproof {

int CountSharpCorners(const Path& path, const RobotSpec& robot) {
  constexpr double kAside_m = 0.02, kSame_m = 1e-6;
  if (robot.turn_radius_m == 0) return 0;
  // An arc of radius R that touches both legs passes the corner at R (1 / cos(half) - 1).
  const double least_cos = robot.turn_radius_m / (robot.turn_radius_m + kAside_m);
  int sharp = 0;
  Vec2 in = Vec2::Zero();
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const Vec2 out = path[i + 1].p_W - path[i].p_W;
    if (out.norm() < kSame_m) continue;
    if (in != Vec2::Zero()) {
      const double turn_rad = std::abs(std::atan2(Cross(in, out), in.dot(out)));
      sharp += std::cos(turn_rad / 2) < least_cos;
    }
    in = out;
  }
  return sharp;
}

}  // namespace floorproof
