// SPDX-License-Identifier: Apache-2.0
// How wrong an estimator's first pose is: keys that `randomise` can draw.
#pragma once

#include "base/params.h"

namespace floorproof {

struct StartError {
  double x_m = 0, y_m = 0, yaw_deg = 0;
  void Visit(ParamVisitor& v) {
    v("start_error_x_m", x_m, Between(-1000, 1000),
      "the first estimate less the truth, world x (m); nothing to `truth`");
    v("start_error_y_m", y_m, Between(-1000, 1000), "the same, world y (m)");
    v("start_error_yaw_deg", yaw_deg, Between(-180, 180), "the same, heading (deg)");
  }
  Pose2 Of(const Pose2& X_WB) const {
    return {X_WB.x_m + x_m, X_WB.y_m + y_m, WrapAngle(X_WB.yaw_rad + yaw_deg * kPi / 180)};
  }
};

}  // namespace floorproof
