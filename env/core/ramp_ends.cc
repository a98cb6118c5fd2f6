// SPDX-License-Identifier: Apache-2.0
#include "env/core/ramp_ends.h"

#include <cmath>

#include "env/core/standing.h"

namespace floorproof {

std::optional<LooseRampEnd> FindLooseRampEnd(const HazardMap& map, const Hazard& hazard) {
  constexpr double kBeyond_m = 0.05, kNotable_m = 0.03, kAlong = 0.7;
  std::optional<LooseRampEnd> worst;
  for (const Solid& slope : hazard.solids) {
    if (!IsSlope(slope)) continue;
    const Vec2 along = slope.gradient.normalized();
    for (std::size_t i = 0; i < slope.base.size(); ++i) {
      const Vec2 a = slope.base[i], edge = slope.base[(i + 1) % slope.base.size()] - a;
      const Vec2 out = Vec2(edge.y(), -edge.x()).normalized(), end_W = a + edge / 2;
      if (std::abs(out.dot(along)) < kAlong) continue;  // a side
      const Vec2 beyond_W = end_W + kBeyond_m * out;
      if (map.IsWall(map.frame.ToCell(beyond_W))) continue;
      const double off_m = TopAt(slope, end_W) - GroundAt(map, beyond_W).height_m;
      if (std::abs(off_m) > (worst ? std::abs(worst->off_m) : kNotable_m))
        worst = LooseRampEnd{end_W, off_m};
    }
  }
  return worst;
}

}  // namespace floorproof
