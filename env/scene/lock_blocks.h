// SPDX-License-Identifier: Apache-2.0
// A reconfigurable robot locked in one shape. Hinges and their motors are removed, and the blocks
// become one rigid body: a robot that never changes its shape need not be simulated as if it could.
#pragma once

#include <mujoco/mujoco.h>

#include "env/core/robot_spec.h"

namespace floorproof {

// The text under <custom> that names the bodies which were blocks, the base aside.
inline constexpr const char* kLockedBlocks = "locked_blocks";

// Turns the blocks of `spec`, from which `robot` was read with its hinges, into `shape` and locks
// them; the frame of `base` becomes the body frame B of that shape.
void LockBlocks(mjSpec* spec, const RobotSpec& robot, const ShapeSpec& shape);

}  // namespace floorproof
