// SPDX-License-Identifier: Apache-2.0
// A scenario's floor as it is for its robot: heights are over the floor on which it starts,
// what its measured limits say of a hazard is known, and levels to which ramps lead are floor.
#pragma once

#include "env/core/levels.h"
#include "env/core/ramps.h"
#include "run/scenario/world.h"

namespace floorproof {

inline HazardMap FloorFor(const World& world, const HazardMap& map) {
  const RobotSpec& robot = world.robot.spec;
  return OpenByRamps(JudgedFor(SeenFrom(map, robot, world.start), robot), robot.step_m);
}

// What planners, controllers and the check of a plan get: all that is known of it.
inline HazardMap KnownFloor(const World& world) {
  return FloorFor(world, KnownPart(world.site.map));
}

// With what is not known: what coverage and drawn maps are held against.
inline HazardMap TrueFloor(const World& world) { return FloorFor(world, world.site.map); }

}  // namespace floorproof
