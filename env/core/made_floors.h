// SPDX-License-Identifier: Apache-2.0
// The floors that hazards make, found by place.
#pragma once

#include <cstddef>
#include <vector>

#include "env/geometry/box_grid.h"

namespace floorproof {

struct MadeFloor {
  Polygon polygon;         // in the world, m
  std::size_t hazard = 0;  // that makes it: its number in the map
  bool level = true;       // of a level change; otherwise the ground of a groove
};

class MadeFloors {
 public:
  explicit MadeFloors(std::vector<MadeFloor> floors);
  // Those that the polygon may overlap, in their order: the boxes around both share more than a
  // border. The list is valid until the next call.
  const std::vector<const MadeFloor*>& Near(const Polygon& polygon);

 private:
  std::vector<MadeFloor> floors_;
  BoxGrid boxes_;  // around each
  std::vector<int> found_;
  std::vector<const MadeFloor*> near_;
};

}  // namespace floorproof
