// SPDX-License-Identifier: Apache-2.0
// A robot driven against the edge of a raised floor.
#pragma once

#include "validate/rig.h"

namespace floorproof {

// Where the edge lies, from the rig's origin, and how far the origin must come for the last wheel
// to stand on top; forward, or to the left.
struct ClimbPlace {
  double edge_m = 0, end_m = 0;
};
// So far before the rim of the first wheels of `rig`, which stands as it was put.
ClimbPlace PlaceEdge(Rig& rig, bool sideways, double run_up_m = 0.005);

// The raised floor: half a plane, from the edge on.
Hazard Ledge(double height_m, double edge_m, bool sideways);

// Drives on until all wheels are on top (true), or until it has not moved forward by a millimetre
// in the time that 6 cm take (false).
bool Climbs(Rig& rig, double end_m, bool sideways, double speed_mps);

}  // namespace floorproof
