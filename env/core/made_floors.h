// SPDX-License-Identifier: Apache-2.0
// The floors that hazards make, found by place.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "env/core/hazard_map.h"
#include "env/geometry/box_grid.h"

namespace floorproof {

struct MadeFloor {
  Polygon polygon;         // in the world, m
  std::size_t hazard = 0;  // that makes it: its number in the map
  bool level = true;       // of a level change; otherwise the ground of a groove
  bool replaces = true;    // earlier floors; false: it lies on them
};

class MadeFloors {
 public:
  // A level change is a floor all over its footprint, or where it is built, which on a drawing is
  // not its whole cells. A groove is one where it is cut.
  enum class Levels { kFootprints, kBuilt };
  MadeFloors(std::span<const Hazard> hazards, Levels levels);
  // Those that the polygon may overlap, in the hazards' order: the boxes around both share more
  // than a border. The list is valid until the next call.
  const std::vector<const MadeFloor*>& Near(const Polygon& polygon);

 private:
  std::vector<MadeFloor> floors_;  // in the hazards' order
  BoxGrid boxes_;                  // around each
  std::vector<int> found_;
  std::vector<const MadeFloor*> near_;
};

}  // namespace floorproof
