// SPDX-License-Identifier: Apache-2.0
#include "env/core/path.h"

namespace floorproof {

Path FromStart(Path path, const Vec2& start_W) {
  if ((path.front().p_W - start_W).norm() > 1e-6) {
    Waypoint first;
    first.p_W = start_W;
    path.insert(path.begin(), first);
  }
  return path;
}

double Length(const Path& path) {
  double length_m = 0;
  for (std::size_t i = 1; i < path.size(); ++i) length_m += (path[i].p_W - path[i - 1].p_W).norm();
  return length_m;
}

int CountTurns(const Path& path) {
  constexpr double kShortest_m = 1e-6;
  constexpr double kSharp_rad = 10 * kPi / 180;
  int turns = 0;
  std::optional<Vec2> before;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vec2 d = path[i].p_W - path[i - 1].p_W;
    if (d.norm() < kShortest_m) continue;
    if (before && std::abs(std::atan2(Cross(*before, d), before->dot(d))) > kSharp_rad) ++turns;
    before = d;
  }
  return turns;
}

}  // namespace floorproof
