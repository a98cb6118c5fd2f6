// SPDX-License-Identifier: Apache-2.0
#include "env/core/hazard_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace floorproof {

double TopAt(const Solid& solid, const Vec2& p_W) {
  if (!IsSlope(solid)) return solid.z_high_m;
  double highest = -std::numeric_limits<double>::infinity();
  for (const Vec2& corner : solid.base) highest = std::max(highest, solid.gradient.dot(corner));
  return solid.z_high_m - (highest - solid.gradient.dot(p_W));
}

double HighestOn(const Solid& solid, const Polygon& part) {
  if (!IsSlope(solid)) return solid.z_high_m;
  double highest_m = -std::numeric_limits<double>::infinity();
  for (const Vec2& corner : part) highest_m = std::max(highest_m, TopAt(solid, corner));
  return highest_m;
}

HazardMap KnownPart(const HazardMap& map) {
  HazardMap known = map;
  std::erase_if(known.hazards, [](const Hazard& h) { return !h.known; });
  return known;
}

std::vector<std::vector<HazardSize>> LevelSizes(double height_m) {
  const double size_m = std::abs(height_m);
  return {{{"step", size_m}, {"drop", size_m}}};
}

bool IsObstacle(const Hazard& hazard, double step_m) {
  if (hazard.crossable) return !*hazard.crossable;
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
