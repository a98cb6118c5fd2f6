// SPDX-License-Identifier: Apache-2.0
// Ramp ends that do not meet the floor beyond them.
#pragma once

#include <optional>

#include "env/core/hazard_map.h"

namespace floorproof {

struct LooseRampEnd {
  Vec2 p_W = Vec2::Zero();  // the middle of its edge
  double off_m = 0;         // its height over the floor beyond; negative: below it
};

// The end of this ramp with the largest height difference to the floor beyond it, if that is more
// than 30 mm. None if all ends meet a floor or the hazard is no ramp. Ends at walls are ignored.
std::optional<LooseRampEnd> FindLooseRampEnd(const HazardMap& map, const Hazard& hazard);

}  // namespace floorproof
