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
  Vec2 Reach() const { return round ? Vec2::Constant(half_m.x()) : half_m; }
  // Whether what lies at `by` from the centre is inside, or `slack` deep inside.
  bool Holds(const Vec2& by, double slack = 0) const {
    if (round) return by.norm() < half_m.x() - slack;
    return std::abs(by.x()) < half_m.x() - slack && std::abs(by.y()) < half_m.y() - slack;
  }
};

}  // namespace floorproof
