// SPDX-License-Identifier: Apache-2.0
#include "run/episode/path_error.h"

#include <algorithm>
#include <cmath>

namespace floorproof {

// Steps sideways through the clearance field, as far as each reading says is free.
double HalfWidth(const ClearanceField& clearance, const Path& path, std::size_t segment,
                 const Vec2& p_W) {
  constexpr double kMax_m = 1.0, kTouch_m = 0.02;
  if (segment + 1 >= path.size()) return kMax_m;
  const Vec2 &a = path[segment].p_W, &b = path[segment + 1].p_W;
  const double length = (b - a).norm();
  if (length < 1e-9) return kMax_m;
  const Vec2 on_path = a + NearestFraction(a, b, p_W) * (b - a);
  const Vec2 left((a - b).y() / length, (b - a).x() / length);
  double width = 0;
  for (const double side : {1.0, -1.0}) {
    double s = 0;
    while (s < kMax_m) {
      const double free = clearance.At(on_path + side * s * left);
      if (free < kTouch_m) break;
      s += free;
    }
    width += std::min(s, kMax_m);
  }
  return width / 2;
}

Vec2 OffTrack(const Path& path, std::size_t segment, const Vec2& p_W) {
  if (path.size() < 2) return p_W - path.front().p_W;
  segment = std::min(segment, path.size() - 2);
  const Vec2 &a = path[segment].p_W, &b = path[segment + 1].p_W;
  return p_W - (a + NearestFraction(a, b, p_W) * (b - a));
}

}  // namespace floorproof
