// SPDX-License-Identifier: Apache-2.0
#include "planners/search/any_angle_floor.h"

namespace floorproof {

AnyAngleFloor::AnyAngleFloor(const Grid<std::uint8_t>& free) : around_(free.width, free.height) {
  for (std::size_t i = 0; i < free.cells.size(); ++i)
    around_.cells[i] = free.cells[i] ? kFree : std::uint8_t{0};
  for (int iy = 0; iy + 1 < free.height; ++iy) {
    const auto is_full = [&](int ix) {
      return free(ix, iy) && free(ix + 1, iy) && free(ix, iy + 1) && free(ix + 1, iy + 1);
    };
    for (int ix = 0; ix + 1 < free.width; ++ix) {
      if (!is_full(ix)) continue;
      const int first = ix;
      for (; ix + 1 < free.width && is_full(ix); ++ix) {
        around_(ix, iy) |= Square(1, 1);
        around_(ix + 1, iy) |= Square(-1, 1);
        around_(ix, iy + 1) |= Square(1, -1);
        around_(ix + 1, iy + 1) |= Square(-1, -1);
      }
      runs_.push_back({first, ix});
    }
    first_run_.push_back(static_cast<int>(runs_.size()));
  }
  constexpr std::uint8_t kAllFull = Square(-1, -1) | Square(1, -1) | Square(-1, 1) | Square(1, 1);
  for (int iy = 0; iy < free.height; ++iy) {
    for (int ix = 0; ix < free.width; ++ix) {
      const std::uint8_t around = around_(ix, iy);
      if (!(around & kFree) || (around & kAllFull) == kAllFull) continue;
      bool is_thin = false;
      ForThinSteps({ix, iy}, [&](Cell, double) { is_thin = true; });
      if (!is_thin) continue;
      around_(ix, iy) |= kThin;
      thin_.push_back(ix);
    }
    first_thin_.push_back(static_cast<int>(thin_.size()));
  }
}

// Along a side: where no full square borders the step. Diagonally: where the square is not full,
// and neither way round its sides leads along full squares.
bool AnyAngleFloor::IsThinStep(Cell c, Cell step) const {
  if (!IsFree(c + step)) return false;
  if (step.ix == 0 || step.iy == 0) return !IsOpen(c, step);
  if (IsFull(c, step.ix, step.iy)) return false;
  const Cell along{step.ix, 0}, across{0, step.iy};
  const auto leads_round = [&](Cell first, Cell second) {
    return IsFree(c + first) && IsOpen(c, first) && IsOpen(c + first, second);
  };
  return !leads_round(along, across) && !leads_round(across, along);
}

}  // namespace floorproof
