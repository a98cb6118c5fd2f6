// SPDX-License-Identifier: Apache-2.0
// What an obstacle hides on a grid of clearances.
#pragma once

#include "env/geometry/grid.h"

namespace floorproof {

// Whether no cell of clearance 0 lies on the straight line between two points, in cells. Cells of
// clearance 0 around `from` itself do not count: a tool's centre may be over an obstacle. Points
// beyond the grid see nothing. `clearance` and `cell` are in m.
bool InSight(const Grid<float>& clearance_m, double cell_m, const Vec2& from_G, const Vec2& to_G);

}  // namespace floorproof
