// SPDX-License-Identifier: Apache-2.0
#include "measure/mirror_image.h"

#include <algorithm>
#include <cmath>

namespace floorproof {
namespace {

constexpr double kSame_m = 0.002;

bool Same(double a, double b) { return std::abs(a - b) <= kSame_m; }

bool IsMirrored(const Shape2& shape) {
  const auto has_partner = [&](const Vec2& p) {
    return std::ranges::any_of(shape.footprint_B, [&](const Vec2& q) {
      return Same(p.x(), q.x()) && Same(p.y(), -q.y());
    });
  };
  return std::ranges::all_of(shape.footprint_B, has_partner);
}

}  // namespace

bool IsMirrorImage(const RobotSpec& robot) {
  constexpr double kSame_rad = 0.01;
  const auto mirrored = [&](const WheelSpec& a, const WheelSpec& b) {
    return Same(a.p_BW.x(), b.p_BW.x()) && Same(a.p_BW.y(), -b.p_BW.y()) &&
           Same(a.radius_m, b.radius_m) &&
           std::abs(a.roller_angle_rad + b.roller_angle_rad) <= kSame_rad;
  };
  const auto has_partner = [&](const WheelSpec& wheel) {
    return std::ranges::any_of(robot.wheels,
                               [&](const WheelSpec& other) { return mirrored(wheel, other); });
  };
  return std::ranges::all_of(robot.wheels, has_partner) && Same(robot.p_BCom.y(), 0) &&
         IsMirrored(robot.clear) && IsMirrored(robot.tool);
}

}  // namespace floorproof
