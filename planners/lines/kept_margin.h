// SPDX-License-Identifier: Apache-2.0
// A margin kept all over a floor but where there is no room for it: such a place is passed in its
// middle, with half of what is free on either side.
//
//   KeptMargin kept(room, held, margin_m, bare);
//   Floor floor = CropFloor(kept.area(), Grown(held.clear, margin_m), ...);
//   path_W = kept.Centred(path_W);
#pragma once

#include <vector>

#include "env/core/coverage.h"
#include "planners/lines/held_yaw.h"

namespace floorproof {

class KeptMargin {
 public:
  // `bare`: what can be swept without a margin, from `room`. The start may lack room.
  KeptMargin(const FloorRoom& room, const HeldShapes& held, double margin_m, const SweepArea& bare,
             const Vec2& start_W);

  // The poses that keep the margin, those in the middle of what is narrower, and what the tool
  // sweeps from them.
  const SweepArea& area() const { return area_; }
  // The path, with its points in narrow places moved to their middle, to a fraction of a cell.
  std::vector<Vec2> Centred(const std::vector<Vec2>& path_W) const;
  // How many narrow places this path leads through.
  int PlacesOn(const std::vector<Vec2>& path_W) const;

 private:
  bool IsNarrow(const Vec2& p_G) const;
  Vec2 Middle(const Vec2& p_G) const;

  Grid<std::uint8_t> free_;    // poses without the margin, connected to the start
  Grid<std::uint8_t> narrow_;  // poses of `area_` that lack it
  int reach_;                  // cells to either side: what is wider is not narrow
  SweepArea area_;
};

}  // namespace floorproof
