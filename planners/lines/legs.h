// SPDX-License-Identifier: Apache-2.0
// A plan as the straight legs that it consists of.
#pragma once

#include <vector>

#include "env/core/path.h"

namespace floorproof {

struct Leg {
  Pose2 from;  // at its beginning, facing along it
  double length_m = 0;
  std::vector<Waypoint> ends;  // of the plan, at its end; the first says how it is driven
  bool dwells = false;         // there
  Pose2 At(double s_m) const {
    const Vec2 p = from * Vec2(s_m, 0);
    return {p.x(), p.y(), from.yaw_rad};
  }
};

// What lies on a straight, is driven at one speed and dwells at its end alone is one leg. The first
// stands for the start, X_WB: it faces as the robot does, and has no length.
std::vector<Leg> LegsOf(const Path& path, const Pose2& start);

}  // namespace floorproof
