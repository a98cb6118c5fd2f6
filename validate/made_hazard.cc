// SPDX-License-Identifier: Apache-2.0
#include "validate/made_hazard.h"

#include "base/config.h"
#include "env/hazards/hazard_type.h"

namespace floorproof {

Hazard MakeHazard(std::string_view type, const std::string& keys, const std::vector<Vec2>& place) {
  const auto plugin = MakePlugin(HazardTypes(), type, "type");
  ReadParams(ParseYaml("{" + keys + "}", "validate"), "", *plugin);
  Hazard hazard = plugin->Make(place);
  hazard.keys = NumericParams(*plugin);
  hazard.type = hazard.id = type;
  hazard.known = false;
  return hazard;
}

}  // namespace floorproof
