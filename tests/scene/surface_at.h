// SPDX-License-Identifier: Apache-2.0
// How high the floor of a built scene is, by a ray from above.
#pragma once

#include "env/scene/scene.h"

namespace floorproof {

// World z of the first surface below 1 m at this place, m; the robot lets the ray pass.
inline double SurfaceAt(const Scene& scene, const mjData* data, const Vec2& p) {
  const mjtNum from[3] = {p.x(), p.y(), 1}, down[3] = {0, 0, -1};
  const mjtByte groups[mjNGROUP] = {0, 0, 0, 0, 1, 1};
  int geom = -1;
  return 1 -
         mj_ray(scene.model.get(), data, from, down, groups, 1, scene.base_body, &geom, nullptr);
}

}  // namespace floorproof
