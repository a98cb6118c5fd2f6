// SPDX-License-Identifier: Apache-2.0
// How hazards look on every map, picture or page: their colours and names.
#pragma once

#include <string>
#include <vector>

#include "env/core/hazard_map.h"
#include "render/text.h"

namespace floorproof {

struct HazardLook {
  Rgb colour{};
  std::string label{};  // "C3 step (not on the map)"
};

// One a hazard of the map, in its order: its class's colour, a shade of it for each of its types.
std::vector<HazardLook> HazardLooks(const HazardMap& map);

Rgb HazardClassColour(HazardClass hazard_class);

// `share` of the way from one colour to the other.
Rgb MixColours(const Rgb& from, const Rgb& to, double share);

}  // namespace floorproof
