// SPDX-License-Identifier: Apache-2.0
// Every robot of models/list.inc, for tests of what must hold on all of them.
#pragma once

#include <string>
#include <vector>

#include "env/scene/robot_model.h"

namespace floorproof {

inline std::vector<std::string> RobotNames() {
  std::vector<std::string> names;
  for (const RobotEntry& entry : Robots()) names.emplace_back(entry.name);
  return names;
}

}  // namespace floorproof
