// SPDX-License-Identifier: Apache-2.0
// Distances by pairs of a corner and an edge, one of which is nearest where convex polygons are
// apart. The depth is found by halving: `b` is cut by the edges of `a` drawn in by s, and what is
// left of it vanishes at the depth.
#include "env/geometry/convex.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace floorproof {
namespace {

// The part of `b` on the inner side of all edges of `a`, each drawn in by `by_m`.
Polygon CutBy(const Polygon& a, double by_m, const Polygon& b) {
  Polygon rest = b, kept;
  for (std::size_t i = 0; i < a.size() && !rest.empty(); ++i) {
    const Vec2 edge = a[(i + 1) % a.size()] - a[i];
    const double length_m = edge.norm();
    if (length_m == 0) continue;
    const auto within = [&](const Vec2& p) { return Cross(edge, p - a[i]) / length_m - by_m; };
    kept.clear();
    for (std::size_t k = 0; k < rest.size(); ++k) {
      const Vec2 &p = rest[k], &q = rest[(k + 1) % rest.size()];
      const double at_p = within(p), at_q = within(q);
      if (at_p >= 0) kept.push_back(p);
      if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0))
        kept.push_back(p + at_p / (at_p - at_q) * (q - p));
    }
    rest.swap(kept);
  }
  return rest;
}

Vec2 Mean(const Polygon& polygon) {
  Vec2 sum = Vec2::Zero();
  for (const Vec2& p : polygon) sum += p;
  return sum / static_cast<double>(polygon.size());
}

// Whether all of `b` lies beyond one edge of `a`.
bool PartedByAnEdge(const Polygon& a, const Polygon& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec2 edge = a[(i + 1) % a.size()] - a[i];
    if (std::ranges::all_of(b, [&](const Vec2& p) { return Cross(edge, p - a[i]) <= 0; }))
      return true;
  }
  return false;
}

Separation Apart(const Polygon& a, const Polygon& b) {
  double least_m2 = std::numeric_limits<double>::infinity();
  Vec2 place = b.front();
  const auto look = [&](const Vec2& p, const Vec2& q, const Vec2& on_b) {
    if ((p - q).squaredNorm() >= least_m2) return;
    least_m2 = (p - q).squaredNorm();
    place = on_b;
  };
  const auto nearest = [](const Polygon& polygon, std::size_t i, const Vec2& p) -> Vec2 {
    const Vec2 &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
    return from + NearestFraction(from, to, p) * (to - from);
  };
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t k = 0; k < b.size(); ++k) {
      const Vec2 on_b = nearest(b, k, a[i]);
      look(a[i], on_b, on_b);
      look(nearest(a, i, b[k]), b[k], b[k]);
    }
  return {std::sqrt(least_m2), place};
}

}  // namespace

Separation Separate(const Polygon& a, const Polygon& b, double deepest_m) {
  if (PartedByAnEdge(a, b) || PartedByAnEdge(b, a)) return Apart(a, b);
  if (std::isfinite(deepest_m))
    if (const Polygon deepest = CutBy(a, deepest_m, b); !deepest.empty())
      return {-deepest_m, Mean(deepest)};
  Polygon left = CutBy(a, 0, b);
  if (left.empty()) return {0, b.front()};  // they touch, to within rounding
  constexpr double kFine_m = 1e-5;
  double low_m = 0, high_m = 0;
  for (const Vec2& p : a) high_m = std::max(high_m, (p - a.front()).norm());
  high_m = std::min(high_m, deepest_m);
  while (high_m - low_m > kFine_m) {
    const double middle_m = (low_m + high_m) / 2;
    Polygon deeper = CutBy(a, middle_m, b);
    if (deeper.empty()) {
      high_m = middle_m;
    } else {
      low_m = middle_m;
      left.swap(deeper);
    }
  }
  return {-low_m, Mean(left)};
}

Polygon ConvexIntersection(const Polygon& a, const Polygon& b) {
  constexpr double kTouch_m = 1e-9, kOneCorner_m = 5e-9;
  Polygon shared;
  for (const Vec2& p : CutBy(a, -kTouch_m, b))
    if (shared.empty() || (p - shared.back()).norm() > kOneCorner_m) shared.push_back(p);
  while (shared.size() > 1 && (shared.front() - shared.back()).norm() <= kOneCorner_m)
    shared.pop_back();
  return shared;
}

Polygon SweptBy(const Polygon& polygon, const Vec2& by) {
  std::vector<Vec2> points = polygon;
  for (const Vec2& p : polygon) points.push_back(p + by);
  return ConvexHull(std::move(points));
}

}  // namespace floorproof
