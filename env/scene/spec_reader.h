// SPDX-License-Identifier: Apache-2.0
// What a robot's compiled MJCF says of it.
#pragma once

#include <mujoco/mujoco.h>

#include <string>

#include "env/core/robot_spec.h"

namespace floorproof {

// The robot as it stands in the model, whose actuators all have names, with all its hinges and
// shapes. Throws InputError naming `file` and what is missing or cannot be.
RobotSpec ReadSpec(const mjModel* model, const std::string& file);

}  // namespace floorproof
