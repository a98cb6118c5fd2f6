// SPDX-License-Identifier: Apache-2.0
// The floor as it is for who drives a path: what the path leads over is no obstacle there.
#pragma once

#include <cstddef>
#include <vector>

#include "env/core/coverage.h"
#include "env/core/hazard_map.h"
#include "env/core/path.h"

namespace floorproof {

// Indices of the map's level changes, and of the terrain that its robot does not cross
// (JudgedFor), that the path's line meets: crosses, touches or lies within, where no later level
// covers them.
// Steps beside it are not among them, nor are blind objects and glass, which nobody crosses.
std::vector<std::size_t> LevelChangesOnTheWay(const HazardMap& map, const Path& path);

// Distances to what the driver of a path must keep off: these level changes count as floor like any
// other.
ClearanceField ClearanceOnTheWay(HazardMap map, const std::vector<std::size_t>& on_the_way,
                                 double step_m);

}  // namespace floorproof
