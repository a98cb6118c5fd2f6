// SPDX-License-Identifier: Apache-2.0
// A scenario's floor as it is for its robot: heights are over the floor on which it starts,
// what its measured limits say of a hazard is known, and levels to which ramps lead are floor.
#pragma once

#include "env/core/levels.h"
#include "env/core/ramps.h"
#include "run/scenario/scenario.h"

namespace floorproof {

inline HazardMap FloorFor(const Scenario& s, const HazardMap& map) {
  const RobotSpec& robot = s.robot.spec;
  return OpenByRamps(JudgedFor(SeenFrom(map, robot, s.start), robot), robot.step_m);
}

// What planners, controllers and the check of a plan get: all that is known of it.
inline HazardMap KnownFloor(const Scenario& s) { return FloorFor(s, KnownPart(s.site.map)); }

// With what is not known: what coverage and drawn maps are held against.
inline HazardMap TrueFloor(const Scenario& s) { return FloorFor(s, s.site.map); }

}  // namespace floorproof
