// SPDX-License-Identifier: Apache-2.0
// What a robot knows of the floor around it, as a picture that turns with it.
#pragma once

#include <cstdint>
#include <vector>

#include "env/core/coverage.h"
#include "env/known/known_map.h"

namespace floorproof {

struct World;

// values[channel][row][column]: the robot in the middle, its x to the right, its y up. Channels:
// obstacles (255; 127: not known), floor that it swept, floor that it is to sweep (255). All is
// what the robot may know: its map, or the one that it draws, and where it thinks that it was.
class LocalMap {
 public:
  // Throws InputError where there are no such cells.
  LocalMap(const World& world, int cells, double cell_m);

  // Once a control period: the tool was moved to here.
  void Sweep(const Pose2& X_WB) { swept_.Add(X_WB); }
  // `drawn`: by its mapper; nullptr: it draws none. Allocates nothing.
  void Look(const Pose2& X_WB, const KnownMap* drawn);

  const std::vector<std::uint8_t>& values() const { return values_; }
  int cells() const { return cells_; }
  double sweepable_m2() const { return area_.area_m2(); }  // of the floor as it is known

 private:
  int cells_;
  double cell_m_;
  SweepArea area_;
  std::vector<std::uint8_t> floor_;  // of the area's cells: what is known of each
  CoverageMeter swept_;
  std::vector<std::uint8_t> values_;
};

}  // namespace floorproof
