// SPDX-License-Identifier: Apache-2.0
// How far a robot's colliding geoms can be from its base, and how far its joints can move them.
#pragma once

#include <mujoco/mujoco.h>

#include <vector>

namespace floorproof {

// Upper bounds, m, that hold in every position of the robot's joints (slide joints without limits:
// within half a metre).
struct RobotReach {
  double centres_m = 0;       // from the base's origin to the centre of a geom
  double surface_m = 0;       // to any point of a geom
  std::vector<double> arm_m;  // per joint: from its axis to the centre of a geom that it carries
};

RobotReach ComputeReach(const mjModel* model, int base_body);

// How far from its centre a geom is touched.
double TouchRadius(const mjModel* model, int geom);

// Whether it can be told what is near: the robot is all that moves, and MuJoCo neither overrides
// margins nor lets what stands still sleep. True of all but very unusual robots.
bool NearnessIsKnown(const mjModel* model, int base_body);

// Whether the geom can touch anything, by its bits or by a pair.
std::vector<bool> CanTouch(const mjModel* model);

}  // namespace floorproof
