// SPDX-License-Identifier: Apache-2.0
// What a scene looks like: materials, sky, light and the picture's quality. Nothing here touches
// the physics.
#pragma once

#include <mujoco/mujoco.h>

#include "env/geometry/grid.h"

namespace floorproof {

// The middle of the map, in the world.
Vec2 MiddleOf(const GridFrame& frame);

// Adds the materials "floor", "wall" and "pit", and all that lights a map of this frame.
void AddLooks(const GridFrame& frame, mjSpec* spec);

}  // namespace floorproof
