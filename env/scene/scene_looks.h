// SPDX-License-Identifier: Apache-2.0
// What a scene looks like: materials, sky, light and the picture's quality. Nothing here touches
// the physics.
#pragma once

#include <mujoco/mujoco.h>

#include <string>

#include "env/geometry/grid.h"

namespace floorproof {

// The middle of the map, in the world.
Vec2 MiddleOf(const GridFrame& frame);

// The names of the scene's materials.
struct Looks {
  std::string floor, wall, pit;
};

// Adds the materials, and all that lights a map of this frame.
Looks AddLooks(const GridFrame& frame, mjSpec* spec);

}  // namespace floorproof
