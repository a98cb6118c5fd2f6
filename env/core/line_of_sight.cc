// SPDX-License-Identifier: Apache-2.0
#include "env/core/line_of_sight.h"

#include "env/geometry/grid_line.h"
#include "env/geometry/interpolate.h"

namespace floorproof {

bool InSight(const Grid<float>& clearance_m, double cell_m, const Vec2& from_G, const Vec2& to_G) {
  constexpr double kSlack = 3;  // cells: points beside their cells' centres, walls drawn back
  const Cell from{RoundDown(from_G.x()), RoundDown(from_G.y())};
  const Cell to{RoundDown(to_G.x()), RoundDown(to_G.y())};
  if (!clearance_m.Inside(from) || !clearance_m.Inside(to)) return false;
  const double free = static_cast<double>(clearance_m(from) + clearance_m(to)) / cell_m;
  if (free > (to_G - from_G).norm() + kSlack) return true;
  bool is_out = false, is_blocked = false;
  VisitCellsBefore(from_G, to_G, [&](Cell c) {
    const bool is_free = clearance_m(c) > 0;
    is_blocked = is_out && !is_free;
    is_out = is_out || is_free;
    return !is_blocked;
  });
  return !is_blocked;
}

}  // namespace floorproof
