// SPDX-License-Identifier: Apache-2.0
#include "planners/lines/held_yaw.h"

#include <algorithm>
#include <cmath>

namespace floorproof {
namespace {

bool LooksTheSameTurned(const Polygon& footprint_B) {
  constexpr double kSame_m = 1e-3;
  const Pose2 turn{0, 0, kPi / 2};
  return std::all_of(footprint_B.begin(), footprint_B.end(), [&](const Vec2& p) {
    return std::abs(SignedDistance(footprint_B, turn * p)) < kSame_m;
  });
}

}  // namespace

Shape2 Turned(Shape2 shape, double yaw_rad) {
  for (Vec2& corner : shape.footprint_B) corner = Pose2{0, 0, yaw_rad}.Rotate(corner);
  return shape;
}

HeldShapes HoldYaw(const HazardMap& map, const Pose2& start, const Shape2& clear,
                   const Shape2& tool) {
  HeldShapes held{{}, clear, tool};
  if (clear.kind == Shape2::Kind::kCircle) return held;
  const double map_yaw = map.frame.X_WG.yaw_rad, quarter = kPi / 2;
  const double turned = std::round((start.yaw_rad - map_yaw) / quarter) * quarter;
  held.yaw_rad = WrapAngle(map_yaw + turned);
  if (LooksTheSameTurned(clear.footprint_B)) return held;
  held.clear = Turned(clear, turned);
  held.tool = Turned(tool, turned);
  held.yaws = Yaws::kFirst;
  return held;
}

}  // namespace floorproof
