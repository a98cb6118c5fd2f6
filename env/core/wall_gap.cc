// SPDX-License-Identifier: Apache-2.0
#include "env/core/wall_gap.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace floorproof {
namespace {

double Reach(const Shape2& shape) {
  if (shape.kind == Shape2::Kind::kCircle) return shape.radius_m;
  double reach_m = 0;
  for (const Vec2& p : shape.footprint_B) reach_m = std::max(reach_m, p.norm());
  return reach_m;
}

// Between the footprint and the square [low, high] of the map's frame; 0 where they overlap.
double Distance(const Polygon& footprint_B, const Pose2& X_GB, const Pose2& X_BG, const Vec2& low,
                const Vec2& high) {
  double distance_m = std::numeric_limits<double>::infinity();
  for (const Vec2& p_B : footprint_B) {
    const Vec2 p_G = X_GB * p_B;
    distance_m = std::min(distance_m, (p_G.cwiseMax(low).cwiseMin(high) - p_G).norm());
  }
  for (const Vec2& corner_G : {low, high, Vec2(low.x(), high.y()), Vec2(high.x(), low.y())})
    distance_m = std::min(distance_m, SignedDistance(footprint_B, X_BG * corner_G));
  return std::max(distance_m, 0.0);
}

}  // namespace

double WallGap(const HazardMap& map, const Shape2& shape, const Pose2& X_WB, double most_m) {
  const GridFrame& frame = map.frame;
  const Pose2 X_GB = frame.X_WG.Inverse() * X_WB;
  const double reach_m = Reach(shape), far_m = reach_m + most_m, cell_m = frame.cell_m;
  const Pose2 X_BG = X_GB.Inverse();

  const auto cell = [&](double at_m) { return static_cast<int>(std::floor(at_m / cell_m)); };
  double gap_m = most_m;
  // All that lies beyond the map counts as wall: its outermost ring says as much as the rest.
  const int x0 = std::max(cell(X_GB.x_m - far_m), -1), y0 = std::max(cell(X_GB.y_m - far_m), -1);
  const int x1 = std::min(cell(X_GB.x_m + far_m), frame.width);
  const int y1 = std::min(cell(X_GB.y_m + far_m), frame.height);
  for (int iy = y0; iy <= y1; ++iy)
    for (int ix = x0; ix <= x1; ++ix) {
      if (!map.IsWall(ix, iy)) continue;
      const Vec2 low = cell_m * Vec2(ix, iy), high = low + Vec2(cell_m, cell_m);
      const double centre_m = (X_GB.p().cwiseMax(low).cwiseMin(high) - X_GB.p()).norm();
      if (centre_m - reach_m >= gap_m) continue;
      gap_m = std::min(gap_m, shape.kind == Shape2::Kind::kCircle
                                  ? centre_m - reach_m
                                  : Distance(shape.footprint_B, X_GB, X_BG, low, high));
    }
  return std::max(gap_m, 0.0);
}

}  // namespace floorproof
