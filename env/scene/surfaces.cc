// SPDX-License-Identifier: Apache-2.0
#include "env/scene/surfaces.h"

#include <utility>

#include "env/geometry/box.h"

namespace floorproof {
namespace {

constexpr double kLeast_m2 = 1e-8;  // of a piece: less is a border that two share

std::vector<Polygon> SurfacesOf(const Hazard& hazard, const Box2& near) {
  std::vector<Polygon> surfaces;
  for (const Solid& solid : hazard.solids)
    if (solid.kind == Solid::Kind::kSurface && Overlap(BoxAround(solid.base), near))
      surfaces.push_back(solid.base);
  return surfaces;
}

}  // namespace

std::vector<SurfacePiece> SurfacesOn(const HazardMap& map, std::size_t first, const Polygon& convex,
                                     double yaw_rad) {
  std::vector<SurfacePiece> pieces;
  std::vector<Region> bare = {{convex, {}}};
  for (std::size_t h = map.hazards.size(); h-- > first && !bare.empty();) {
    const std::vector<Polygon> surfaces = SurfacesOf(map.hazards[h], BoxAround(convex));
    if (surfaces.empty()) continue;
    const std::vector<Region> under = Intersection(bare, surfaces);
    if (Area(under) < kLeast_m2) continue;
    for (Polygon& part : ConvexParts(under, yaw_rad))
      pieces.push_back({std::move(part), static_cast<int>(h)});
    bare = Difference(bare, surfaces);
  }
  if (pieces.empty()) return {{convex, -1}};
  for (Polygon& part : ConvexParts(bare, yaw_rad)) pieces.push_back({std::move(part), -1});
  return pieces;
}

}  // namespace floorproof
