// SPDX-License-Identifier: Apache-2.0
// The world's geoms: floors, walls and hazards, with what they are to the detectors.
#pragma once

#include <mujoco/mujoco.h>

#include <string>
#include <vector>

#include "env/core/hazard_map.h"
#include "env/scene/free_names.h"
#include "env/scene/restitution.h"
#include "env/scene/scene.h"

namespace floorproof {

// Contact bits, as the robots' MJCF states them: wheels meet the floor and hazards, the body all.
inline constexpr int kFloorBit = 1, kWallBit = 2;

class WorldGeoms {
 public:
  struct Built {
    mjsGeom* geom = nullptr;
    GeomRole role;
  };
  // Both outlive it. The robot is in `spec` already: names make way for its own.
  WorldGeoms(const HazardMap& map, const ContactWalk& walk, mjSpec* spec);

  // A geom of no shape yet.
  mjsGeom* Add(GeomRole role, double friction, double restitution);
  // The prism: a box where it is one, else a convex mesh.
  mjsGeom* Extrude(const Solid& solid, GeomRole role, double friction, double restitution);
  const std::vector<Built>& all() const { return all_; }

 private:
  std::string Name(const GeomRole& role) const;

  const HazardMap& map_;
  ContactWalk walk_;
  mjSpec* spec_;
  mjsBody* world_;
  FreeNames geom_names_, mesh_names_;
  std::vector<Built> all_;
};

// The attitude that is turned so far about the vertical.
void SetYaw(double* quat, double yaw_rad);

}  // namespace floorproof
