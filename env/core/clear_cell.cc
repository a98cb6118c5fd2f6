// SPDX-License-Identifier: Apache-2.0
#include "env/core/clear_cell.h"

#include <limits>

namespace floorproof {

std::optional<Cell> ClearCellAt(const Grid<std::uint8_t>& free, Cell c, const Vec2& p_G) {
  std::optional<Cell> best;
  double best_d = std::numeric_limits<double>::infinity();
  if (free.Inside(c) && free(c)) return c;
  for (int iy = c.iy - 1; iy <= c.iy + 1; ++iy)
    for (int ix = c.ix - 1; ix <= c.ix + 1; ++ix) {
      const double d = (Vec2(ix + 0.5, iy + 0.5) - p_G).norm();
      if (free.Inside(ix, iy) && free(ix, iy) && d < best_d) best = Cell{ix, iy}, best_d = d;
    }
  return best;
}

}  // namespace floorproof
