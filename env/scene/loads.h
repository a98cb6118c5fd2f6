// SPDX-License-Identifier: Apache-2.0
// The loads on the wheels and casters of a robot at rest on level floor.
#pragma once

#include <mujoco/mujoco.h>

#include <vector>

#include "env/core/robot_spec.h"

namespace floorproof {

// A geom of a wheel or caster.
struct LoadedGeom {
  int geom = -1;
  double load_n = 0;
};

// All of them, in the order of their geoms. The load is that of the spring that it slides on and
// what hangs below that, as the model stands, where its springs let it stand so; else what balances
// the weight, by statics on three points, on more as if those without a spring stood on alike ones.
std::vector<LoadedGeom> LoadsOf(const mjModel* model, const RobotSpec& robot);

// The joint on which the body rolls: a hinge that does not stand upright, or a ball; -1: it has
// none.
int RollingJoint(const mjModel* model, int body);

// Whether an actuator turns this body.
bool IsDriven(const mjModel* model, int body);

}  // namespace floorproof
