// SPDX-License-Identifier: Apache-2.0
#include "env/core/hazard_parts.h"

#include <utility>

#include "env/core/levels.h"

namespace floorproof {

HazardParts::HazardParts(const HazardMap& map, Counts counts) {
  const std::vector<std::vector<Polygon>> floors = BareFloors(map);
  std::vector<Box2> boxes;
  for (std::size_t i = 0; i < floors.size(); ++i) {
    if (!counts(map.hazards[i])) continue;
    for (const Polygon& bare : floors[i])
      for (Polygon& part : ConvexParts({{bare, {}}})) {
        boxes.push_back(BoxAround(part));
        parts_.push_back({std::move(part), static_cast<int>(i)});
      }
  }
  if (boxes.empty()) return;
  boxes_ = BoxGrid(std::move(boxes));
  constexpr double kSquare_m = 1.5;  // half of one that holds any robot and its reach
  found_.reserve(static_cast<std::size_t>(boxes_.MostNear(kSquare_m)));
}

}  // namespace floorproof
