// SPDX-License-Identifier: Apache-2.0
// Ranges of a planar scan against the walls as they are built (inset faces and what lies beyond the
// map included), cast in the map: the physics holds only the walls near the robot.
// Hazards' solids, the floor and the robot are not in the map: rays meet those in the physics.
#pragma once

#include <span>

#include "env/core/geometry.h"
#include "env/map/wall_grid.h"

namespace floorproof {

// Horizontal rays from X_GS (the scanner in the map's frame G) at height_m above the base floor, at
// `angles_rad` from the scanner's x axis, counter-clockwise. Writes to ranges_m (as many) the
// distance to the first wall, infinity where none is met within most_m. Allocates nothing.
void CastScan(const WallGrid& walls, const Pose2& X_GS, double height_m,
              std::span<const double> angles_rad, double most_m, std::span<double> ranges_m);

}  // namespace floorproof
