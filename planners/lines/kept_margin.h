// SPDX-License-Identifier: Apache-2.0
// Keeps a margin wherever the floor is wide enough for it. Narrower places are passed in their
// middle, with half of the free width on either side.
//
//   KeptMargin kept(room, held, margin_m, bare, start_W);
//   Floor floor = CropFloor(kept.area(), Grown(held.clear, margin_m), ...);
//   path_W = kept.Centred(path_W);
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "env/core/coverage.h"
#include "planners/lines/floor.h"
#include "planners/lines/held_yaw.h"

namespace floorproof {

class KeptMargin {
 public:
  // `bare`: what can be swept without a margin, from `room`. The start may lack room, and so may
  // `places_W`, to which paths are kept open.
  KeptMargin(const FloorRoom& room, const HeldShapes& held, double margin_m, const SweepArea& bare,
             const Vec2& start_W, const std::vector<Vec2>& places_W = {});

  // The poses that keep the margin, the poses in the middle of narrower places, and the area that
  // the tool sweeps from them.
  const SweepArea& area() const { return area_; }
  // Moves the points of a path in narrow places to their middle, to a fraction of a cell. The first
  // point stays; with `keep_end` the last one does, too.
  std::vector<Vec2> Centred(const std::vector<Vec2>& path_W, bool keep_end = false) const;
  // How many narrow places this path leads through.
  int PlacesOn(const std::vector<Vec2>& path_W) const;

 private:
  Vec2 ToCells(const Vec2& p_W) const { return frame_.ToGrid(p_W) / frame_.cell_m; }
  bool IsNarrow(const Vec2& p_G) const;
  bool IsFree(const Vec2& a_G, const Vec2& b_G) const;  // the straight way between
  std::optional<Vec2> Middle(const Vec2& p_G) const;

  struct Sample {
    Vec2 p;
    std::optional<Vec2> middle;  // of the narrow place that it is in
    bool is_corner;              // of the path
  };
  std::vector<Sample> Sampled(const Polyline& path_G) const;
  Polyline MiddleOf(std::span<const Sample> stretch) const;

  GridFrame frame_;
  Grid<std::uint8_t> free_;    // poses without the margin, connected to the start
  Grid<std::uint8_t> narrow_;  // poses of `area_` that lack it
  int reach_;                  // cells to either side: what is wider is not narrow
  SweepArea area_;
};

}  // namespace floorproof
