// SPDX-License-Identifier: Apache-2.0
// What a robot knows of a floor from its own sensors. An online planner sees nothing else.
#pragma once

#include <vector>

#include "env/core/hazard_map.h"

namespace floorproof {

// A place where the robot was touched, or where it found no floor. Scans pass over such a place, so
// no scan can erase the mark.
struct FloorMark {
  enum class Kind { kBump, kDrop };
  Kind kind = Kind::kBump;
  Vec2 p_W = Vec2::Zero();
  double radius_m = 0;
};

struct KnownMap {
  static constexpr float kSure = 0.8f;  // beyond these log odds a cell counts as free, or occupied

  GridFrame frame;
  Grid<float> log_odds;          // of occupied, from the scans; 0: unknown
  Grid<std::uint8_t> marked;     // 1: the cell lies within a mark
  std::vector<FloorMark> marks;  // in the order in which they were made

  CellState At(int ix, int iy) const {
    if (marked(ix, iy)) return CellState::kOccupied;
    const float odds = log_odds(ix, iy);
    if (odds >= kSure) return CellState::kOccupied;
    return odds <= -kSure ? CellState::kFree : CellState::kUnknown;
  }
};

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
