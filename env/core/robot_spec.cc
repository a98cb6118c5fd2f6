// SPDX-License-Identifier: Apache-2.0
#include "env/core/robot_spec.h"

#include <algorithm>
#include <cmath>

namespace floorproof {

std::string_view Name(Standstill standstill) {
  switch (standstill) {
    case Standstill::kBrake:
      return "brake";
    case Standstill::kHold:
      return "hold";
    case Standstill::kFree:
      break;
  }
  return "free";
}

Standstill UsualStandstill(double mass_kg) {
  return mass_kg > kHeavyRobot_kg ? Standstill::kBrake : Standstill::kHold;
}

double EdgeAlong(const Shape2& shape, double bearing_rad) {
  if (shape.kind == Shape2::Kind::kCircle) return shape.radius_m;
  const Vec2 way(std::cos(bearing_rad), std::sin(bearing_rad));
  double farthest = 0;
  const Polygon& p = shape.footprint_B;
  for (std::size_t i = 0, j = p.size() - 1; i < p.size(); j = i++) {
    const Vec2 edge = p[i] - p[j];
    const double across = Cross(way, edge);
    if (std::abs(across) < 1e-12) continue;
    const double along = Cross(p[j], edge) / across, t = Cross(p[j], way) / across;
    if (along > 0 && t >= -1e-9 && t <= 1 + 1e-9) farthest = std::max(farthest, along);
  }
  return farthest;
}

Shape2 Grown(Shape2 shape, double margin_m) {
  if (shape.kind == Shape2::Kind::kCircle)
    shape.radius_m += margin_m;
  else
    shape.footprint_B = Offset(shape.footprint_B, margin_m);
  return shape;
}

}  // namespace floorproof
