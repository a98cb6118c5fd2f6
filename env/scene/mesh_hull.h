// SPDX-License-Identifier: Apache-2.0
// The convex hull by which a mesh collides.
#pragma once

#include <mujoco/mujoco.h>

#include "env/geometry/geometry.h"

namespace floorproof {

// Calls visit(p) for each vertex of a mesh's convex hull, in the mesh's own frame; for all its
// vertices if MuJoCo has made no hull.
template <class Visit>
void ForEachHullVertex(const mjModel* m, int mesh, const Visit& visit) {
  const float* vertices = m->mesh_vert + 3 * m->mesh_vertadr[mesh];
  // A hull's data begin with the number of its vertices and of its faces, then come the vertices'
  // first edges and then their numbers.
  const int* graph = m->mesh_graphadr[mesh] < 0 ? nullptr : m->mesh_graph + m->mesh_graphadr[mesh];
  const int num = graph == nullptr ? m->mesh_vertnum[mesh] : graph[0];
  for (int i = 0; i < num; ++i) {
    const float* v = vertices + 3 * (graph == nullptr ? i : graph[2 + num + i]);
    visit(Vec3(v[0], v[1], v[2]));
  }
}

}  // namespace floorproof
