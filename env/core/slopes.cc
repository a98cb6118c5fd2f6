// SPDX-License-Identifier: Apache-2.0
#include "env/core/slopes.h"

#include <algorithm>
#include <cmath>

namespace floorproof {

bool IsRamp(const Hazard& hazard) { return std::ranges::any_of(hazard.solids, IsSlope); }

const Solid* SlopeAt(const Hazard& hazard, const Vec2& p_W) {
  const auto slope = std::ranges::find_if(
      hazard.solids, [&](const Solid& s) { return IsSlope(s) && Contains(s.base, p_W); });
  return slope != hazard.solids.end() ? &*slope : nullptr;
}

bool LeadsOnto(const Hazard& ramp, double height_m, const std::vector<Polygon>* floor,
               double step_m) {
  constexpr double kBeside_m = 0.02;
  const auto holds = [&](const Vec2& p_W) {
    return floor == nullptr || std::ranges::any_of(*floor, [&](const Polygon& part) {
             return SignedDistance(part, p_W) < kBeside_m;
           });
  };
  return std::ranges::any_of(ramp.solids, [&](const Solid& solid) {
    return IsSlope(solid) && std::ranges::any_of(solid.base, [&](const Vec2& corner_W) {
             return std::abs(TopAt(solid, corner_W) - height_m) <= step_m && holds(corner_W);
           });
  });
}

}  // namespace floorproof
