// SPDX-License-Identifier: Apache-2.0
// Wheels feel a border between coplanar boxes (physics.md, trap 9), so there are as few as can be:
// the floor is cut into trapezoids only along the cuts' own direction, from their corners.
#include "env/scene/floor.h"

#include "env/scene/surfaces.h"

namespace floorproof {
namespace {

double LongestEdgeYaw(const Polygon& polygon) {
  Vec2 longest = Vec2::Zero();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    if (edge.norm() > longest.norm() + 1e-9) longest = edge;
  }
  return std::atan2(longest.y(), longest.x());
}

}  // namespace

std::vector<FloorPiece> FloorPieces(const HazardMap& map) {
  struct Cut {
    const Solid* solid;
    int hazard;
  };
  std::vector<Cut> cuts;
  std::vector<Polygon> outlines;
  const Polygon* first_surface = nullptr;
  for (std::size_t h = 0; h < map.hazards.size(); ++h)
    for (const auto& solid : map.hazards[h].solids) {
      if (solid.kind == Solid::Kind::kCut) {
        cuts.push_back({&solid, static_cast<int>(h)});
        outlines.push_back(solid.base);
      }
      if (solid.kind == Solid::Kind::kSurface && first_surface == nullptr)
        first_surface = &solid.base;
    }
  if (cuts.empty() && first_surface == nullptr) return {};

  constexpr double kMargin_m = 2;
  const double yaw = LongestEdgeYaw(cuts.empty() ? *first_surface : outlines.front());
  const double w = map.frame.width * map.frame.cell_m, h = map.frame.height * map.frame.cell_m;
  Polygon ground = Rectangle({-kMargin_m, -kMargin_m}, {w + kMargin_m, h + kMargin_m});
  for (auto& corner : ground) corner = map.frame.X_WG * corner;

  std::vector<FloorPiece> pieces;
  const auto add = [&](const Polygon& part, double z_top_m, int hazard) {
    if (first_surface == nullptr) {
      pieces.push_back({part, z_top_m, hazard});
      return;
    }
    for (auto& piece : SurfacesOn(map, static_cast<std::size_t>(hazard + 1), part, yaw))
      pieces.push_back({std::move(piece.outline), z_top_m, hazard, piece.hazard});
  };
  for (const auto& part : ConvexParts(Difference({Region{ground, {}}}, outlines), yaw))
    add(part, 0, -1);
  // Where cuts overlap the later one's depth holds.
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    const std::vector<Polygon> later(outlines.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                                     outlines.end());
    for (const auto& part : ConvexParts(Difference({Region{outlines[i], {}}}, later), yaw))
      add(part, cuts[i].solid->z_low_m, cuts[i].hazard);
  }
  return pieces;
}

}  // namespace floorproof
