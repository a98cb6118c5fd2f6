// SPDX-License-Identifier: Apache-2.0
#include "env/hazards/rim.h"

#include "base/error.h"
#include "base/params.h"

namespace floorproof {
namespace {

// The corners moved in along their bisectors, so that every edge lies `by_m` farther in.
Polygon MovedIn(const Polygon& polygon, double by_m) {
  Polygon moved;
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 before = (polygon[i] - polygon[(i + n - 1) % n]).normalized();
    const Vec2 after = (polygon[(i + 1) % n] - polygon[i]).normalized();
    const Vec2 in = Vec2(-before.y(), before.x()) + Vec2(-after.y(), after.x());
    const double share = in.squaredNorm() / 2;  // 1 + cos of the turn; 0 where it turns back
    moved.push_back(polygon[i] + (share > 1e-6 ? Vec2(in * (by_m / share)) : Vec2::Zero()));
  }
  return moved;
}

// Whether each edge of `inner` runs as the one of `outer` does: none has turned over.
bool KeepsItsEdges(const Polygon& outer, const Polygon& inner) {
  for (std::size_t i = 0; i < outer.size(); ++i) {
    const std::size_t next = (i + 1) % outer.size();
    if ((inner[next] - inner[i]).dot(outer[next] - outer[i]) <= 0) return false;
  }
  return true;
}

}  // namespace

std::vector<Solid> SlabWithRim(const Polygon& polygon, double height_m, double rim_m,
                               std::string_view key, double value) {
  const Polygon top = rim_m > 0 ? MovedIn(polygon, rim_m) : polygon;
  if (!KeepsItsEdges(polygon, top) || !IsSimple(top))
    throw InputError({}, std::string(key), FormatDouble(value),
                     "makes a slope of " + FormatDouble(rim_m) +
                         " m along the edge, for which the polygon is too narrow");
  std::vector<Solid> solids;
  if (rim_m > 0 && IsConvex(polygon)) return {{Solid::Kind::kPrism, polygon, top, 0, height_m}};
  for (Polygon& part : ConvexParts({{top, {}}}))
    solids.push_back({Solid::Kind::kPrism, std::move(part), {}, 0, height_m});
  if (rim_m <= 0) return solids;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const std::size_t next = (i + 1) % polygon.size();
    // A wedge: all of its top is the line at its inner edge.
    solids.push_back({Solid::Kind::kPrism,
                      {polygon[i], polygon[next], top[next], top[i]},
                      {top[i], top[next], top[next], top[i]},
                      0,
                      height_m});
  }
  return solids;
}

}  // namespace floorproof
