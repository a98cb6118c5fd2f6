// SPDX-License-Identifier: Apache-2.0
#include "env/core/hazard_map.h"

#include <cmath>

namespace floorproof {

HazardMap KnownPart(const HazardMap& map) {
  HazardMap known = map;
  std::erase_if(known.hazards, [](const Hazard& h) { return !h.known; });
  return known;
}

bool IsObstacle(const Hazard& hazard, double step_m) {
  switch (hazard.hazard_class) {
    case HazardClass::kBlindObject:
    case HazardClass::kGlass:
      return true;
    case HazardClass::kLevelChange:
      return std::abs(hazard.height_m) > step_m;
    case HazardClass::kTerrain:
      return false;
  }
  return true;
}

}  // namespace floorproof
