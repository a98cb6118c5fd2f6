// SPDX-License-Identifier: Apache-2.0
// A plan: waypoints joined by straight segments.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "env/geometry/geometry.h"

namespace floorproof {

struct Waypoint {
  Vec2 p_W = Vec2::Zero();
  std::optional<double>
      yaw_rad;           // body heading on the way here (holonomic robots); none: along the way
  std::string shape;     // of a reconfigurable robot; empty: as it is
  double speed_mps = 0;  // on the way here; 0: the robot's cruise speed
  double dwell_s = 0;    // stand here for this long, in simulated time
};

using Path = std::vector<Waypoint>;

double Length(const Path& path);  // m
// Corners sharper than 10 degrees, zero-length segments passed over.
int CountTurns(const Path& path);

}  // namespace floorproof
