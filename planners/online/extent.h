// SPDX-License-Identifier: Apache-2.0
// How far something reaches around a robot's centre: what must stay free, what the tool sweeps.
#pragma once

#include <algorithm>
#include <cmath>

#include "env/geometry/geometry.h"

namespace floorproof {

// A disc; or an upright rectangle in the ground's axes, of a robot that keeps its heading.
struct Extent {
  Vec2 half_m = Vec2::Zero();  // of its sides
  bool round = true;           // a disc, of radius half_m.x()

  // In other units.
  Extent operator/(double unit_m) const { return {half_m / unit_m, round}; }
  Extent Wider(double by_m) const { return {half_m + Vec2::Constant(by_m), round}; }
  Vec2 Reach() const { return round ? Vec2::Constant(half_m.x()) : half_m; }
  // Whether what lies at `by` from the centre is inside, or `slack` deep inside.
  bool Holds(const Vec2& by, double slack = 0) const {
    if (round) return by.norm() < half_m.x() - slack;
    return std::abs(by.x()) < half_m.x() - slack && std::abs(by.y()) < half_m.y() - slack;
  }
  // The same on its way, straight from the centre to `way`.
  bool PassesOver(const Vec2& by, const Vec2& way, double slack = 0) const {
    if (round)
      return Holds(
          by - std::clamp(by.dot(way) / std::max(way.squaredNorm(), 1e-12), 0.0, 1.0) * way, slack);
    double first = 0, last = 1;  // of the way, while it is within both pairs of sides
    for (int k = 0; k < 2; ++k) {
      const double half = half_m[k] - slack;
      if (std::abs(way[k]) < 1e-12) {
        if (std::abs(by[k]) >= half) return false;
        continue;
      }
      const double in = (by[k] - half) / way[k], out = (by[k] + half) / way[k];
      first = std::max(first, std::min(in, out));
      last = std::min(last, std::max(in, out));
    }
    return first <= last;
  }
  // Whether any of an upright square is inside, of which `by` is the middle.
  bool HoldsPartOf(const Vec2& by, double half_side, double slack = 0) const {
    const Vec2 half = Vec2::Constant(half_side);
    return Holds(Vec2::Zero().cwiseMax(by - half).cwiseMin(by + half), slack);
  }
  // The same on its way.
  bool PassesOverSquare(const Vec2& by, double half_side, const Vec2& way, double slack = 0) const {
    if (!round) return Wider(half_side).PassesOver(by, way, slack);
    const Vec2 half = Vec2::Constant(half_side);
    for (int k = 0; k < 2; ++k) {
      Extent beside{half, false};
      beside.half_m[k] += half_m.x() - slack;
      if (beside.PassesOver(by, way)) return true;
    }
    for (const Vec2& corner : {Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1), Vec2(-1, 1)})
      if (PassesOver(by + corner * half_side, way, slack)) return true;
    return false;
  }
};

}  // namespace floorproof
