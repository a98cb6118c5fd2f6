// SPDX-License-Identifier: Apache-2.0
// What a ray of a sensor meets: floor and hazards in the physics, walls where the model does not
// hold them all in the map. The robot itself lets rays pass.
#pragma once

#include "env/geometry/geometry.h"
#include "env/scene/scene.h"

namespace floorproof {

struct RayHit {
  double range_m = std::numeric_limits<double>::infinity();
  int geom = -1;                 // of the scene's model; -1: nothing, or a wall of the map
  Vec3 normal_W = Vec3::Zero();  // where a geom was met
  bool hits() const { return range_m < std::numeric_limits<double>::infinity(); }
};

// Rays in a scene while its robot moves; the scene outlives it.
class Rays {
 public:
  // May be made anew for every episode; allocates.
  explicit Rays(const Scene& scene);

  // From p_W along direction_W (length 1), to the first surface within most_m, panes of glass
  // included. Allocates nothing.
  RayHit Cast(const mjData* data, const Vec3& p_W, const Vec3& direction_W, double most_m) const;
  // The same for many rays from one point: faster than one by one.
  // `directions_W`: n directions, x y z each; hits: n.
  void CastAll(mjData* data, const Vec3& p_W, const std::vector<double>& directions_W,
               double most_m, std::vector<RayHit>& hits);

 private:
  RayHit Wall(const Vec3& p_W, const Vec3& direction_W, double most_m) const;

  const Scene& scene_;
  std::vector<int> geom_;  // scratch of CastAll
  std::vector<double> range_, normal_;
};

}  // namespace floorproof
