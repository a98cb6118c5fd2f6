// SPDX-License-Identifier: Apache-2.0
#include "env/scene/farthest_along.h"

#include <limits>

#include "env/scene/mesh_hull.h"

namespace floorproof {

Vec3 FarthestAlong(const mjModel* m, int geom, const Vec3& way) {
  const mjtNum* size = m->geom_size + 3 * geom;
  const auto end = [](double component, double half) { return component < 0 ? -half : half; };
  switch (m->geom_type[geom]) {
    case mjGEOM_SPHERE:
      return size[0] * way;
    case mjGEOM_CAPSULE:
      return size[0] * way + Vec3(0, 0, end(way.z(), size[1]));
    case mjGEOM_ELLIPSOID: {
      const Vec3 axes(size);
      return axes.cwiseProduct(axes.cwiseProduct(way).normalized());
    }
    case mjGEOM_CYLINDER: {
      const Vec2 across = size[0] * way.head<2>().normalized();
      return {across.x(), across.y(), end(way.z(), size[1])};
    }
    case mjGEOM_BOX:
      return {end(way.x(), size[0]), end(way.y(), size[1]), end(way.z(), size[2])};
    default: {
      Vec3 farthest = Vec3::Zero();
      double most = -std::numeric_limits<double>::infinity();
      ForEachHullVertex(m, m->geom_dataid[geom], [&](const Vec3& p) {
        if (p.dot(way) > most) most = p.dot(way), farthest = p;
      });
      return farthest;
    }
  }
}

}  // namespace floorproof
