// SPDX-License-Identifier: Apache-2.0
#include "env/map/ray_cast.h"

#include <cmath>
#include <limits>

namespace floorproof {

void CastScan(const WallGrid& walls, const Pose2& X_GS, double height_m,
              std::span<const double> angles_rad, double most_m, std::span<double> ranges_m) {
  const bool level = height_m >= 0 && height_m <= kWallHeight_m;
  for (std::size_t i = 0; i < angles_rad.size(); ++i) {
    const double yaw = X_GS.yaw_rad + angles_rad[i];
    ranges_m[i] = level ? walls.Cast(X_GS.p(), {std::cos(yaw), std::sin(yaw)}, most_m)
                        : std::numeric_limits<double>::infinity();
  }
}

}  // namespace floorproof
