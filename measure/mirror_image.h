// SPDX-License-Identifier: Apache-2.0
// Whether a robot's left is as its right.
#pragma once

#include "env/core/robot_spec.h"

namespace floorproof {

// By what is known of it: wheels (place, size, rollers), centre of mass, footprint, tool.
bool IsMirrorImage(const RobotSpec& robot);

}  // namespace floorproof
