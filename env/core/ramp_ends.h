// SPDX-License-Identifier: Apache-2.0
// Where a ramp ends in the air, or before a face.
#pragma once

#include <optional>

#include "env/core/hazard_map.h"

namespace floorproof {

struct LooseRampEnd {
  Vec2 p_W = Vec2::Zero();  // the middle of its edge
  double off_m = 0;         // its height over the floor beyond; negative: below it
};

// The end of this ramp that is farthest from the floor beyond, by 30 mm or more; none where all
// lead to a floor, and of what is no ramp. Ends at walls do not count.
std::optional<LooseRampEnd> FindLooseRampEnd(const HazardMap& map, const Hazard& hazard);

}  // namespace floorproof
