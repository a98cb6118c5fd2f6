// SPDX-License-Identifier: Apache-2.0
#include "env/core/made_floors.h"

#include <utility>

namespace floorproof {

MadeFloors::MadeFloors(std::vector<MadeFloor> floors) : floors_(std::move(floors)) {
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
