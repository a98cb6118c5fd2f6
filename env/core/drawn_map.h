// SPDX-License-Identifier: Apache-2.0
// The map that a robot drew, joined to the one that it was given, and held against the truth.
#pragma once

#include <vector>

#include "env/core/hazard_map.h"
#include "env/known/known_map.h"

namespace floorproof {

// The map with one more hazard: all that was seen and lies farther than slack_m from everything on
// the map. It blocks the way.
HazardMap WithSeen(const HazardMap& map, const KnownMap& known, double step_m, double slack_m);

// The map with each mark added as a hazard that blocks the way.
HazardMap WithMarks(const HazardMap& map, const std::vector<FloorMark>& marks);

// How far the known map agrees with the truth.
struct KnownAgainstTruth {
  enum State : std::uint8_t { kUnknown, kFree, kOccupied, kWronglyFree, kWronglyOccupied };
  Grid<std::uint8_t> cells;  // a State for each cell of the known map
  double known = 0;          // of the cells on which the robot may drive, the share that is known
  double wrong = 0;          // of the known cells, the share that is wrong
};
// In truth, a cell is occupied if a robot must keep off it (ObstacleMask). A known cell is wrong in
// two cases. It says occupied, but there is nothing to keep off within `slack_m`. Or it says free,
// but there is something to keep off, and no cell within `slack_m` is known as occupied. So a wall
// drawn slightly beside its place is right, and a thin pane of glass that was not drawn is wrong.
KnownAgainstTruth Compare(const KnownMap& known, const HazardMap& truth, double step_m,
                          double slack_m);

}  // namespace floorproof
