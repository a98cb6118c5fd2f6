// SPDX-License-Identifier: Apache-2.0
// The geometrical features of a room near which dirt gathers ("audit-sampling", sections 4.1 and
// 4.2): its boundary and its corners.
#pragma once

#include <vector>

#include "planners/audit/room.h"

namespace floorproof {

// The cells along the room's boundary, in order; they may lie one cell off the map. Empty: there is
// no contour.
//
// Section 4.1, steps 2 and 3: threshold, Zhang-Suen thinning, contours, of which the one that
// encloses most is the boundary; those around furniture are smaller. It is followed on the room's
// side, along both sides of a thin wall that stands into the room. Thinned is the line of cells
// next to the room (MakeRoom), not walls as thick as they are drawn: so the boundary lies one cell
// outside the room on any map, however ragged.
std::vector<Cell> BoundaryOf(const Room& room);

// Sharp corners of walls and furniture. Section 4.2, step 2: FAST (Rosten, Porter & Drummond 2010),
// 9 of 16 pixels, on the room against all else. A median and a Gaussian filter go before it, as the
// walls of a scan are ragged by a cell and slanted ones are staircases, which are no corners. What
// is smaller than three cells has none then. FAST finds a cluster of pixels up to six cells around
// a corner. Returned is, once for each, the cell beside the room where the room's edge bends most;
// like those of the boundary it may lie one cell off the map.
std::vector<Cell> CornersOf(const Room& room);

}  // namespace floorproof
