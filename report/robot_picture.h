// SPDX-License-Identifier: Apache-2.0
// A robot from three sides: what stands on the floor, its centre of mass, its footprint, its sizes.
#pragma once

#include <vector>

#include "media/media.h"
#include "validate/robot_check.h"

namespace floorproof {

// `parts`: PartsOf the robot that was checked.
Image DrawRobot(const RobotCheck& check, const std::vector<RobotPart>& parts);

}  // namespace floorproof
