// SPDX-License-Identifier: Apache-2.0
// The cells on a straight line (Amanatides & Woo, 1987).
#pragma once

#include <cmath>
#include <limits>

#include "env/geometry/grid.h"

namespace floorproof {

// Calls visit(cell) for each cell from the one of `from_G` to the one before that of `to_G`, both
// in cells, until it returns false.
template <class Visit>
void VisitCellsBefore(const Vec2& from_G, const Vec2& to_G, const Visit& visit) {
  const Vec2 way = to_G - from_G;
  int cell[2], last[2], step[2];
  double next[2], stride[2];
  for (int k = 0; k < 2; ++k) {
    cell[k] = static_cast<int>(std::floor(from_G[k]));
    last[k] = static_cast<int>(std::floor(to_G[k]));
    step[k] = way[k] > 0 ? 1 : -1;
    stride[k] = way[k] == 0 ? std::numeric_limits<double>::infinity() : 1 / std::abs(way[k]);
    const double border = cell[k] + (way[k] > 0 ? 1 : 0);
    next[k] = way[k] == 0 ? stride[k] : (border - from_G[k]) / way[k];
  }
  while (cell[0] != last[0] || cell[1] != last[1]) {
    const int k = next[0] < next[1] ? 0 : 1;
    if (next[k] > 1) return;  // rounding: it would pass the end
    if (!visit(Cell{cell[0], cell[1]})) return;
    cell[k] += step[k];
    next[k] += stride[k];
  }
}

}  // namespace floorproof
