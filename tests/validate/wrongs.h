// SPDX-License-Identifier: Apache-2.0
// What the check of a robot says is wrong, a line each.
#pragma once

#include <string>
#include <vector>

#include "validate/robot_check.h"

namespace floorproof {

inline std::vector<std::string> Wrongs(const RobotCheck& check) {
  std::vector<std::string> lines;
  for (const Finding& finding : check.findings)
    if (finding.kind == Finding::Kind::kWrong) lines.push_back(finding.Line());
  return lines;
}

}  // namespace floorproof
