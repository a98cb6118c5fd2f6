// SPDX-License-Identifier: Apache-2.0
// What is wrong about a robot, by its figures and its drive.
#pragma once

#include "validate/robot_check.h"

namespace floorproof {

// Adds to `check.findings`; all else of it has been filled in.
void AddFindings(const RobotModel& robot, RobotCheck& check);

}  // namespace floorproof
