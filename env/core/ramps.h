// SPDX-License-Identifier: Apache-2.0
// Levels that a robot gets to by ramps.
#pragma once

#include "env/core/hazard_map.h"

namespace floorproof {

// The map (as SeenFrom gives it: heights over the floor of the start, which is level 0) with those
// level changes opened that ramps lead to from level 0, one after the other: a ramp joins a level
// where a corner of its slope lies beside it, no more than step_m higher or lower. An opened level
// is floor: it is no hazard any more. What it and each ramp leave is a level change along those of
// their edges at which the floor beside lies higher or lower by more than step_m; its id is that
// of the hazard with " edge". Without ramps the map stays as it is.
HazardMap OpenByRamps(HazardMap map, double step_m);

}  // namespace floorproof
