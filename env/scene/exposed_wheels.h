// SPDX-License-Identifier: Apache-2.0
// Wheels that stand out from under the body.
//
// Walls meet the body, which costs least where it covers the wheels, seen from above. A wheel or
// caster that it does not cover, wherever it swivels or steers, would pass through a wall: it meets
// walls itself. What it meets them with is its collider, the tread's width as the model states it.
#pragma once

#include <mujoco/mujoco.h>

#include "env/core/robot_spec.h"

namespace floorproof {

// Gives the exposed wheels and casters of `spec` the walls' contact bit. `model` was compiled from
// `spec`, `robot` read from it.
void LetExposedWheelsMeetWalls(mjSpec* spec, const mjModel* model, const RobotSpec& robot);

}  // namespace floorproof
