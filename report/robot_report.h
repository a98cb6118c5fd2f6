// SPDX-License-Identifier: Apache-2.0
// A robot's check in words and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "base/console.h"
#include "validate/robot_check.h"

namespace floorproof {

// What was understood of it: name and value.
std::vector<std::pair<std::string, std::string>> RobotFigures(const RobotCheck& check);
// The same as a table, then the drive beside its kinematics, then what was found.
void SayRobot(const RobotCheck& check, const Console& console);
nlohmann::ordered_json RobotCheckJson(const RobotCheck& check);

}  // namespace floorproof
