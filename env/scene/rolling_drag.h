// SPDX-License-Identifier: Apache-2.0
// Wheels on what holds them back as they roll, such as carpet.
#pragma once

#include <mujoco/mujoco.h>

#include <vector>

#include "env/core/robot_spec.h"
#include "env/scene/free_names.h"

namespace floorproof {

// What the robot stands on: a geom of a wheel or caster, rollers of Mecanum wheels aside.
struct Foot {
  mjsGeom* geom = nullptr;
  double radius_m = 0;  // that it rolls on; 0: it slides, as a ball caster that does not turn
};
std::vector<Foot> FeetOf(mjSpec* spec, const RobotSpec& robot);

// Makes the foot touch `ground` with this drag as a share of its load: one that rolls feels a
// torque of drag N R against its turning, which is MuJoCo's rolling friction; one that slides, so
// much more friction. Both geoms need names.
void PairFoot(mjSpec* spec, const Foot& foot, const mjsGeom* ground, double drag);

}  // namespace floorproof
