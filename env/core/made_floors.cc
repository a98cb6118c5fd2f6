// SPDX-License-Identifier: Apache-2.0
#include "env/core/made_floors.h"

#include <utility>

namespace floorproof {

MadeFloors::MadeFloors(std::span<const Hazard> hazards, Levels levels) {
  for (std::size_t i = 0; i < hazards.size(); ++i) {
    const bool level = hazards[i].hazard_class == HazardClass::kLevelChange;
    if (!level && hazards[i].hazard_class != HazardClass::kTerrain) continue;
    if (level && levels == Levels::kFootprints) {
      for (const Polygon& polygon : hazards[i].footprint) floors_.push_back({polygon, i, true});
      continue;
    }
    for (const Solid& solid : hazards[i].solids)
      if (const bool cut = solid.kind == Solid::Kind::kCut; level || cut)
        floors_.push_back({solid.base, i, level, cut || !hazards[i].lies_on_floor});
  }
  std::vector<Box2> boxes;
  for (const MadeFloor& floor : floors_) boxes.push_back(BoxAround(floor.polygon));
  boxes_ = BoxGrid(std::move(boxes));
}

const std::vector<const MadeFloor*>& MadeFloors::Near(const Polygon& polygon) {
  const Box2 box = BoxAround(polygon);
  boxes_.Near(box.low, box.high, found_);
  near_.clear();
  for (const int i : found_) {
    const auto at = static_cast<std::size_t>(i);
    if (Overlap(box, boxes_.boxes()[at])) near_.push_back(&floors_[at]);
  }
  return near_;
}

}  // namespace floorproof
