// SPDX-License-Identifier: Apache-2.0
// What a robot knows of a floor from its own sensors. An online planner sees nothing else.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "env/geometry/grid.h"

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

  KnownMap() = default;
  explicit KnownMap(const GridFrame& on)
      : frame(on), log_odds(on.width, on.height), marked(on.width, on.height) {}

  GridFrame frame;
  Grid<float> log_odds;          // of occupied, from the scans; 0: unknown
  Grid<std::uint8_t> marked;     // 1: the cell lies within a mark
  std::vector<FloorMark> marks;  // in the order in which they were made
  // For who goes by what is new: the cells of another state than before, some of them twice, until
  // they are cleared. None: nobody does.
  std::optional<std::vector<Cell>> changed;

  CellState At(int ix, int iy) const {
    if (marked(ix, iy)) return CellState::kOccupied;
    const float odds = log_odds(ix, iy);
    if (odds >= kSure) return CellState::kOccupied;
    return odds <= -kSure ? CellState::kFree : CellState::kUnknown;
  }
  CellState At(Cell c) const { return At(c.ix, c.iy); }

  // Cells off the map are passed over.
  void Add(int ix, int iy, double log_odds_of_occupied, double most);
  // What is met again within radius_m is larger than it was thought to be: by half of that. Its
  // cells are those whose centres lie in the mark, and its middle's.
  void Mark(FloorMark::Kind kind, const Vec2& p_W, double radius_m);

 private:
  void Tell(int ix, int iy, CellState before) {
    if (changed && At(ix, iy) != before) changed->push_back({ix, iy});
  }
};

}  // namespace floorproof
