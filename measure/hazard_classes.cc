// SPDX-License-Identifier: Apache-2.0
#include "measure/hazard_classes.h"

#include "env/geometry/polygon.h"
#include "env/hazards/hazard_type.h"

namespace floorproof {

std::map<std::string, HazardClass> ClassOfType() {
  std::map<std::string, HazardClass> classes;
  for (const auto& entry : HazardTypes()) {
    const auto type = entry.make();
    const bool line = type->placement() == HazardType::Placement::kLine;
    const std::vector<Vec2> place =
        line ? std::vector<Vec2>{{0, 0}, {1, 0}} : Rectangle({0, 0}, {1, 1});
    classes[std::string(entry.name)] = type->Make(place).hazard_class;
  }
  return classes;
}

}  // namespace floorproof
