// SPDX-License-Identifier: Apache-2.0
// A plan: waypoints joined by straight segments.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "env/geometry/geometry.h"

namespace floorproof {

// What the robot is to do at a waypoint beside driving there. Plans carry tasks from the planner to
// who does them. A tracker knows nothing of them: it hands them on while it dwells there.
struct WaypointTask {
  enum class Kind { kSample };  // to take one here
  Kind kind = Kind::kSample;
  int id = 0;  // the planner's number of it, by which its plan says more
  bool operator==(const WaypointTask&) const = default;
};

struct Waypoint {
  Vec2 p_W = Vec2::Zero();
  std::optional<double> yaw_rad;  // body heading on the way here (holonomic robots); none: along
                                  // the way. Others that turn on the spot face it where they dwell
  std::string shape;              // of a reconfigurable robot; empty: as it is
  double speed_mps = 0;           // on the way here; 0: the robot's cruise speed
  double dwell_s = 0;             // stand here for this long, in simulated time
  bool stops = false;  // where the way bends here it is not cut: the robot stops, and then turns
  std::optional<WaypointTask> task = {};  // to be done here
};

using Path = std::vector<Waypoint>;

// A plan that need not begin where the robot stands: the way there first, from this place, p_W.
Path FromStart(Path path, const Vec2& start_W);

double Length(const Path& path);  // m
// Corners sharper than 10 degrees, zero-length segments passed over.
int CountTurns(const Path& path);

}  // namespace floorproof
