// SPDX-License-Identifier: Apache-2.0
// Steps of the engine, walked in parts where a foot meets an edge.
//
// A tyre swings faster than a step of 4 ms can follow. On the floor that is no matter: the implicit
// integrator damps the swing and the tyre carries its load. At an edge the tyre's force decides
// what the robot climbs. So while a foot touches something, or may touch it within the step, whose
// normal is more than 15 degrees off upright, the step is walked in as many parts as keep the phase
// of the stiffest tyre below 0.25 rad, at most 8. Geometry and speed decide, never a thing's name.
//
// Contacts that bounce get whole steps, for which their softness is computed (restitution.h).
#pragma once

#include <mujoco/mujoco.h>

#include <vector>

#include "env/core/motion.h"
#include "env/core/robot_spec.h"
#include "env/scene/scene.h"

namespace floorproof {

class FineSteps {
 public:
  // `scene` outlives it.
  FineSteps(const Scene& scene, const RobotSpec& robot);

  // Into how many parts the next step is to be walked, by the contacts of the last.
  int Parts(const mjModel* m, const mjData* d, const Truth& truth) const;
  // One step in so many parts. Body velocities (`cvel`), with which contacts are read, are those
  // before the whole step. Throws InternalError when the engine fails. Allocates nothing.
  void Walk(mjModel* m, mjData* d, int parts);
  // Into how many away from edges.
  int OnFloor(const mjModel* m) const;

 private:
  const Scene& scene_;
  double reach_m_;            // of the robot, about its origin
  std::vector<mjtNum> cvel_;  // scratch
};

}  // namespace floorproof
