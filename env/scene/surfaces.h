// SPDX-License-Identifier: Apache-2.0
// What lies on floors without a height of its own, such as water: where it gives them its friction.
#pragma once

#include <vector>

#include "env/core/hazard_map.h"

namespace floorproof {

// A convex piece of a floor's ground plan, and the hazard whose surface lies on it.
struct SurfacePiece {
  Polygon outline;
  int hazard = -1;  // index into HazardMap::hazards; -1: bare
};

// The convex polygon, cut along the borders of the surfaces that hazards from `first` on lay on it;
// of several the last holds. Cuts run along `yaw_rad` where they can. What no surface meets stays
// whole.
std::vector<SurfacePiece> SurfacesOn(const HazardMap& map, std::size_t first, const Polygon& convex,
                                     double yaw_rad);

}  // namespace floorproof
