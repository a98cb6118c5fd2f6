// SPDX-License-Identifier: Apache-2.0
// A scenario's floor as it is for its robot: heights are over the floor on which it starts,
// and levels to which ramps lead are floor.
#pragma once

#include "env/core/levels.h"
#include "env/core/ramps.h"
#include "run/scenario/scenario.h"

namespace floorproof {

// What planners, controllers and the check of a plan get: all that is known of it.
inline HazardMap KnownFloor(const Scenario& s) {
  return OpenByRamps(SeenFrom(KnownPart(s.site.map), s.robot.spec, s.start), s.robot.spec.step_m);
}

// With what is not known: what coverage and drawn maps are held against.
inline HazardMap TrueFloor(const Scenario& s) {
  return OpenByRamps(SeenFrom(s.site.map, s.robot.spec, s.start), s.robot.spec.step_m);
}

}  // namespace floorproof
