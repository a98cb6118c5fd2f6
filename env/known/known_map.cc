// SPDX-License-Identifier: Apache-2.0
#include "env/known/known_map.h"

#include <algorithm>
#include <cmath>

namespace floorproof {

void KnownMap::Add(int ix, int iy, double log_odds_of_occupied, double most) {
  if (!log_odds.Inside(ix, iy)) return;
  const CellState before = At(ix, iy);
  float& odds = log_odds(ix, iy);
  odds =
      static_cast<float>(std::clamp(static_cast<double>(odds) + log_odds_of_occupied, -most, most));
  Tell(ix, iy, before);
}

void KnownMap::Mark(FloorMark::Kind kind, const Vec2& p_W, double radius_m) {
  auto mark = std::ranges::find_if(
      marks, [&](const FloorMark& m) { return (m.p_W - p_W).norm() < radius_m; });
  if (mark != marks.end())
    mark->radius_m += radius_m / 2;
  else
    mark = marks.insert(marks.end(), {kind, p_W, radius_m});
  const Vec2 p_G = frame.ToGrid(mark->p_W) / frame.cell_m;
  const int reach = static_cast<int>(std::ceil(mark->radius_m / frame.cell_m));
  const int cx = static_cast<int>(std::floor(p_G.x())), cy = static_cast<int>(std::floor(p_G.y()));
  for (int iy = cy - reach; iy <= cy + reach; ++iy)
    for (int ix = cx - reach; ix <= cx + reach; ++ix) {
      if (!marked.Inside(ix, iy)) continue;
      const bool middle = ix == cx && iy == cy;
      if (!middle && (frame.Center(ix, iy) - mark->p_W).norm() > mark->radius_m) continue;
      const CellState before = At(ix, iy);
      marked(ix, iy) = 1;
      Tell(ix, iy, before);
    }
}

}  // namespace floorproof
