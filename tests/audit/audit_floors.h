// SPDX-License-Identifier: Apache-2.0
// Floors, and tapes with a known number of particles, for the audit's tests.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/streams.h"
#include "env/audit/tape.h"
#include "env/core/hazard_map.h"

namespace floorproof::testing {

inline HazardMap BareRoom(double width_m, double height_m, double cell_m = 0.05,
                          const Pose2& X_WG = {}) {
  HazardMap map;
  map.frame = {static_cast<int>(std::lround(width_m / cell_m)),
               static_cast<int>(std::lround(height_m / cell_m)), cell_m, X_WG};
  map.occupancy = Grid<CellState>(map.frame.width, map.frame.height, CellState::kFree);
  return map;
}

inline void AddWall(HazardMap& map, int x0, int y0, int x1, int y1) {
  for (int iy = y0; iy <= y1; ++iy)
    for (int ix = x0; ix <= x1; ++ix) map.occupancy(ix, iy) = CellState::kOccupied;
}

// So many particles anywhere on a tape, their diameters those of the audit paper.
inline std::vector<LiftedParticle> Sprinkled(int count, std::uint64_t seed) {
  Stream random(seed, 0, "sprinkled");
  std::vector<LiftedParticle> particles;
  for (int i = 0; i < count; ++i) {
    const double x = random.Uniform(-0.01, 0.01), y = random.Uniform(-0.01, 0.01);
    particles.push_back({Vec2(x, y), random.Uniform(0.0005, 0.001)});
  }
  return particles;
}

// Back and forth over a room, as a round robot of this radius would.
inline std::vector<Pose2> ZigZag(double width_m, double height_m, double radius_m, double row_m) {
  std::vector<Pose2> poses;
  bool back = false;
  for (double y = radius_m;; y += row_m, back = !back) {
    const double at = std::min(y, height_m - radius_m);
    const double from = back ? width_m - radius_m : radius_m, to = width_m - from;
    poses.push_back({from, at, back ? kPi : 0.0});
    poses.push_back({to, at, back ? kPi : 0.0});
    if (y >= height_m - radius_m) return poses;
  }
}

}  // namespace floorproof::testing
