// SPDX-License-Identifier: Apache-2.0
// The base floor: one plane, or, where something is cut out of it, few large convex slabs.
#pragma once

#include <vector>

#include "env/core/hazard_map.h"

namespace floorproof {

// A horizontal piece of floor whose top lies at z_top_m.
struct FloorPiece {
  Polygon outline;  // convex, world frame
  double z_top_m = 0;
  int hazard = -1;   // the hazard whose bottom it is; -1: the base floor
  int surface = -1;  // the hazard whose surface lies on it; -1: bare
};

// Empty when nothing is cut and no surface lies on it: then the floor is a plane. Otherwise the
// bottoms of the cuts, and slabs that tile the map and a margin around it, with seams only along
// the longest edge of the first cut or surface, and along the borders of surfaces.
std::vector<FloorPiece> FloorPieces(const HazardMap& map);

}  // namespace floorproof
