// SPDX-License-Identifier: Apache-2.0
// Convex polygons: how far apart they are, how deep one reaches into another, what one sweeps.
// All of them have three corners or more, counter-clockwise.
#pragma once

#include <limits>

#include "env/geometry/polygon.h"

namespace floorproof {

// How far two convex polygons are apart; negative where they overlap.
struct Separation {
  double distance_m = 0;
  Vec2 place = Vec2::Zero();  // the nearest point of `b`, or the middle of its deepest within `a`
};

// Positive: the least distance between them. Negative: by how much all edges of `a` would have to
// move inwards for `b` to be outside of it (so a wall that clips a side by 2 cm is -0.02 m, and a
// wall right across -half of a's width); overlaps deeper than `deepest_m` count as so deep, and are
// found sooner. O(corners of a * corners of b).
Separation Separate(const Polygon& a, const Polygon& b,
                    double deepest_m = std::numeric_limits<double>::infinity());

// What two convex polygons share. Where they but touch, to within a nanometre, that is one corner
// or two; empty where they are apart.
Polygon ConvexIntersection(const Polygon& a, const Polygon& b);

// All that the polygon covers while it moves straight by `by`, without turning.
Polygon SweptBy(const Polygon& polygon, const Vec2& by);

}  // namespace floorproof
