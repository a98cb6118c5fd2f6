// SPDX-License-Identifier: Apache-2.0
// Wheels feel a border between coplanar boxes (physics.md, trap 9), so there are as few as can be:
// the floor is cut into trapezoids only along the cuts' own direction, from their corners.
#include "env/scene/floor.h"

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
  for (std::size_t h = 0; h < map.hazards.size(); ++h)
    for (const auto& solid : map.hazards[h].solids)
      if (solid.kind == Solid::Kind::kCut) {
        cuts.push_back({&solid, static_cast<int>(h)});
        outlines.push_back(solid.base);
      }
  if (cuts.empty()) return {};

  constexpr double kMargin_m = 2;
  const double yaw = LongestEdgeYaw(outlines.front());
  const double w = map.frame.width * map.frame.cell_m, h = map.frame.height * map.frame.cell_m;
  Polygon ground = Rectangle({-kMargin_m, -kMargin_m}, {w + kMargin_m, h + kMargin_m});
  for (auto& corner : ground) corner = map.frame.X_WG * corner;

  std::vector<FloorPiece> pieces;
  for (auto& part : ConvexParts(Difference({Region{ground, {}}}, outlines), yaw))
    pieces.push_back({std::move(part), 0.0, -1});
  // Where cuts overlap the later one's depth holds.
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    const std::vector<Polygon> later(outlines.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                                     outlines.end());
    for (auto& part : ConvexParts(Difference({Region{outlines[i], {}}}, later), yaw))
      pieces.push_back({std::move(part), cuts[i].solid->z_low_m, cuts[i].hazard});
  }
  return pieces;
}

}  // namespace floorproof
