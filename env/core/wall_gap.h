// SPDX-License-Identifier: Apache-2.0
// How far a robot is from the nearest wall.
#pragma once

#include "env/core/hazard_map.h"
#include "env/core/robot_spec.h"

namespace floorproof {

// From the shape at this pose to the nearest area of a wall's cell (m; 0 where they overlap);
// `most_m` where none is so near. Takes time as the cells within reach.
double WallGap(const HazardMap& map, const Shape2& shape, const Pose2& X_WB, double most_m);

}  // namespace floorproof
