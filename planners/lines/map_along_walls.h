// SPDX-License-Identifier: Apache-2.0
// A building that is askew to its map, on a grid along its walls.
//
// A robot with a footprint holds a quarter turn of the grid's axes, and its rows run along them. So
// along walls that are askew to the map it would drive staircases.
#pragma once

#include <optional>

#include "env/core/hazard_map.h"
#include "env/core/robot_spec.h"

namespace floorproof {

// The same floor on a grid whose axes run along most of its walls, of cells that the footprint's
// farthest side fills to their edges. A cell is a wall where it overlaps one of the map's walls.
// None if the walls run along the map's own axes, to within 3 deg, or in no clear direction, or if
// the grid would be too large.
std::optional<HazardMap> MapAlongWalls(const HazardMap& map, const Shape2& footprint);

}  // namespace floorproof
