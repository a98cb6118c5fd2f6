// SPDX-License-Identifier: Apache-2.0
// What a robot knows of a floor by its own sensors: all that an online planner sees.
#pragma once

#include <vector>

#include "env/core/hazard_map.h"

namespace floorproof {

// A place that was touched, or where there was no floor: scans pass over it, so none of them can
// take it back.
struct FloorMark {
  enum class Kind { kBump, kDrop };
  Kind kind = Kind::kBump;
  Vec2 p_W = Vec2::Zero();
  double radius_m = 0;
};

struct KnownMap {
  static constexpr float kSure = 0.8f;  // log odds beyond which a cell is free, or occupied

  GridFrame frame;
  Grid<float> log_odds;          // that a cell is occupied, as scans say; 0: nothing is known
  Grid<std::uint8_t> marked;     // 1: within one of the marks
  std::vector<FloorMark> marks;  // in the order in which they were made

  CellState At(int ix, int iy) const {
    if (marked(ix, iy)) return CellState::kOccupied;
    const float odds = log_odds(ix, iy);
    if (odds >= kSure) return CellState::kOccupied;
    return odds <= -kSure ? CellState::kFree : CellState::kUnknown;
  }
};

// The map with what was seen and is not on it, further than slack_m from all that is, as one thing
// that blocks the way.
HazardMap WithSeen(const HazardMap& map, const KnownMap& known, double step_m, double slack_m);

// The map with the marks on it as things that block the way.
HazardMap WithMarks(const HazardMap& map, const std::vector<FloorMark>& marks);

// What is known against what is there.
struct KnownAgainstTruth {
  enum State : std::uint8_t { kUnknown, kFree, kOccupied, kWronglyFree, kWronglyOccupied };
  Grid<std::uint8_t> cells;  // of the known map
  double known = 0;          // share of the cells on which the robot may drive that is known
  double wrong = 0;          // share of the known cells that is wrong
};
// Occupied is what a robot must keep off (ObstacleMask). A cell is wrong that says occupied with
// nothing to keep off within `slack_m`, or free where there is something to keep off and nothing is
// known occupied within `slack_m`: a wall drawn a little beside its place is not, a thin pane that
// was not drawn is.
KnownAgainstTruth Compare(const KnownMap& known, const HazardMap& truth, double step_m,
                          double slack_m);

}  // namespace floorproof
