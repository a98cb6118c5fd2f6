// SPDX-License-Identifier: Apache-2.0
// How tightly a plan turns.
#pragma once

#include <algorithm>
#include <cmath>

#include "env/core/path.h"

namespace floorproof::testing {

// The radius of the tightest arc that the plan takes, by the turn at each waypoint over half of
// both segments that meet there: an arc of equal chords gives its own radius. Infinity: straight.
inline double TightestTurn(const Path& path) {
  double tightest_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    const Vec2 in = path[i].p_W - path[i - 1].p_W, out = path[i + 1].p_W - path[i].p_W;
    if (in.norm() == 0 || out.norm() == 0) continue;
    const double turn_rad = std::abs(std::atan2(Cross(in, out), in.dot(out)));
    if (turn_rad > 1e-6)
      tightest_m = std::min(tightest_m, 0.5 * (in.norm() + out.norm()) / turn_rad);
  }
  return tightest_m;
}

}  // namespace floorproof::testing
