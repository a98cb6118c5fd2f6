// SPDX-License-Identifier: Apache-2.0
#include "env/core/wall_gap.h"

#include <algorithm>
#include <cmath>

namespace floorproof {
namespace {

double Reach(const Shape2& shape) {
  if (shape.kind == Shape2::Kind::kCircle) return shape.radius_m;
  double reach_m = 0;
  for (const Vec2& p : shape.footprint_B) reach_m = std::max(reach_m, p.norm());
  return reach_m;
}

}  // namespace

double WallGap(const HazardMap& map, const Shape2& shape, const Pose2& X_WB, double most_m) {
  const GridFrame& frame = map.frame;
  const Pose2 X_GB = frame.X_WG.Inverse() * X_WB;
  const double far_m = Reach(shape) + most_m, cell_m = frame.cell_m;
  const auto cell = [&](double at_m) { return static_cast<int>(std::floor(at_m / cell_m)); };
  double gap_m = most_m;
  // All that lies beyond the map counts as wall: its outermost ring says as much as the rest.
  const int x0 = std::max(cell(X_GB.x_m - far_m), -1), y0 = std::max(cell(X_GB.y_m - far_m), -1);
  const int x1 = std::min(cell(X_GB.x_m + far_m), frame.width);
  const int y1 = std::min(cell(X_GB.y_m + far_m), frame.height);
  for (int iy = y0; iy <= y1; ++iy)
    for (int ix = x0; ix <= x1; ++ix) {
      if (!map.IsWall(ix, iy)) continue;
      const Vec2 low = cell_m * Vec2(ix, iy);
      const Vec2 nearest = X_GB.p().cwiseMax(low).cwiseMin(low + Vec2(cell_m, cell_m));
      const Vec2 way_G = nearest - X_GB.p();
      const double distance_m = way_G.norm();
      if (distance_m >= far_m) continue;
      const double bearing_rad = std::atan2(way_G.y(), way_G.x()) - X_GB.yaw_rad;
      gap_m = std::min(gap_m, distance_m - EdgeAlong(shape, bearing_rad));
    }
  return std::max(gap_m, 0.0);
}

}  // namespace floorproof
