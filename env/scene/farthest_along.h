// SPDX-License-Identifier: Apache-2.0
// The support mapping of convex geoms.
#pragma once

#include <mujoco/mujoco.h>

#include "env/geometry/geometry.h"

namespace floorproof {

// The point of a geom's convex hull that lies farthest along a unit vector, both in the geom's own
// frame. Planes and height fields have none.
Vec3 FarthestAlong(const mjModel* model, int geom, const Vec3& way);

}  // namespace floorproof
