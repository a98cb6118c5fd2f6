// SPDX-License-Identifier: Apache-2.0
// Steps of the engine, walked in parts where a foot meets an edge.
//
// A tyre swings faster than a step of 4 ms can follow. On the floor that is no matter: the implicit
// integrator damps the swing and the tyre carries its load. At an edge the tyre's force decides
// what the robot climbs. So while a foot touches something, or may touch it within the step, whose
// normal is more than 15 degrees off upright, the step is walked in as many parts as keep the phase
// of the stiffest tyre below 0.25 rad, at most 8. Geometry and speed decide, never a thing's name.
//
// Contacts that bounce do not divide a step: their softness is computed for whole ones
// (restitution.h).
#pragma once

#include <mujoco/mujoco.h>

#include "env/core/motion.h"
#include "env/core/robot_spec.h"
#include "env/scene/engine.h"
#include "env/scene/scene.h"

namespace floorproof {

// One step in so many parts; `on_part()` is called after each but the last, while the model's time
// step is that of a part. Throws InternalError when the engine fails. Allocates nothing.
template <class OnPart>
void WalkStep(mjModel* m, mjData* d, int parts, const OnPart& on_part) {
  class ScopedTimestep {
   public:
    ScopedTimestep(mjModel* model, double step_s) : model_(model), whole_s_(model->opt.timestep) {
      model->opt.timestep = step_s;
    }
    ~ScopedTimestep() { model_->opt.timestep = whole_s_; }
    ScopedTimestep(const ScopedTimestep&) = delete;
    ScopedTimestep& operator=(const ScopedTimestep&) = delete;

   private:
    mjModel* model_;
    double whole_s_;
  };
  const double end_s = d->time + m->opt.timestep;
  const ScopedTimestep part(m, m->opt.timestep / parts);
  for (int k = 1; k < parts; ++k) {
    StepEngine(m, d);
    on_part();
  }
  StepEngine(m, d);
  d->time = end_s;
}

class FineSteps {
 public:
  // `scene` outlives it.
  FineSteps(const Scene& scene, const RobotSpec& robot);

  // Into how many parts the next step is to be walked, by the contacts of the last.
  int Parts(const mjModel* m, const mjData* d, const Truth& truth) const;
  // Into how many away from edges.
  int OnFloor(const mjModel* m) const;

 private:
  const Scene& scene_;
  double reach_m_;  // of the robot, about its origin
};

}  // namespace floorproof
