// SPDX-License-Identifier: Apache-2.0
// A floor's hazards as convex pieces that are found by place.
#pragma once

#include <vector>

#include "env/core/hazard_map.h"
#include "env/geometry/box_grid.h"

namespace floorproof {

class HazardParts {
 public:
  struct Part {
    Polygon polygon_W;  // convex
    int hazard = 0;     // index into HazardMap::hazards
  };

  // Of each hazard that `counts` what of it is still there (BareFloors, env/core/levels.h).
  using Counts = bool (*)(const Hazard& hazard);
  explicit HazardParts(
      const HazardMap& map, Counts counts = [](const Hazard&) { return true; });

  // The parts whose bounding boxes meet the rectangle [low, high], by hazard ascending. Allocates
  // nothing where the rectangle is at most 3 m long and wide.
  template <class Visit>
  void Near(const Vec2& low_W, const Vec2& high_W, const Visit& visit) {
    if (parts_.empty()) return;
    boxes_.Near(low_W, high_W, found_);
    for (const int i : found_) visit(parts_[static_cast<std::size_t>(i)]);
  }
  bool empty() const { return parts_.empty(); }

 private:
  std::vector<Part> parts_;
  BoxGrid boxes_;
  std::vector<int> found_;
};

}  // namespace floorproof
