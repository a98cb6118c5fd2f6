// SPDX-License-Identifier: Apache-2.0
// Rectangles along the axes of their frame.
#pragma once

#include "env/geometry/polygon.h"

namespace floorproof {

struct Box2 {
  Vec2 low = Vec2::Zero(), high = Vec2::Zero();

  Vec2 Size() const { return high - low; }
};

// The least one that holds all points; there must be one.
inline Box2 BoxAround(const Polygon& points) {
  Box2 box{points.front(), points.front()};
  for (const Vec2& p : points) {
    box.low = box.low.cwiseMin(p);
    box.high = box.high.cwiseMax(p);
  }
  return box;
}

// Whether they share more than a border.
inline bool Overlap(const Box2& a, const Box2& b) {
  return (a.low.array() < b.high.array()).all() && (b.low.array() < a.high.array()).all();
}

}  // namespace floorproof
