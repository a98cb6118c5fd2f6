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

#include "env/core/motion.h"
#include "env/core/robot_spec.h"
#include "env/scene/scene.h"

namespace floorproof {

// Sets a model's time step for as long as it lives.
class TimestepOf {
 public:
  TimestepOf(mjModel* m, double step_s) : m_(m), whole_s_(m->opt.timestep) {
    m->opt.timestep = step_s;
  }
  ~TimestepOf() { m_->opt.timestep = whole_s_; }
  TimestepOf(const TimestepOf&) = delete;
  TimestepOf& operator=(const TimestepOf&) = delete;

 private:
  mjModel* m_;
  double whole_s_;
};

class FineSteps {
 public:
  // `scene` outlives it.
  FineSteps(const Scene& scene, const RobotSpec& robot);

  // Into how many parts the next step is to be walked, by the contacts of the last.
  int Parts(const mjModel* m, const mjData* d, const Truth& truth) const;
  // One step in so many parts; `between()` is called after each but the last, while the model's
  // time step is that of a part. Throws InternalError when the engine fails. Allocates nothing.
  template <class Between>
  static void Walk(mjModel* m, mjData* d, int parts, const Between& between) {
    const double end_s = d->time + m->opt.timestep;
    const TimestepOf part(m, m->opt.timestep / parts);
    for (int k = 1; k < parts; ++k) {
      StepEngine(m, d);
      between();
    }
    StepEngine(m, d);
    d->time = end_s;
  }
  // Into how many away from edges.
  int OnFloor(const mjModel* m) const;

 private:
  const Scene& scene_;
  double reach_m_;  // of the robot, about its origin
};

}  // namespace floorproof
