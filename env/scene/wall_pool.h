// SPDX-License-Identifier: Apache-2.0
// Few boxes that stand for many. For a map with many walls, the model holds only as many boxes as a
// robot can have near it anywhere on the map. Static geoms are not free: MuJoCo goes through all of
// them at each step. env/sim/live_geoms.h makes the boxes those that are near the robot.
#pragma once

#include <mujoco/mujoco.h>

#include "env/geometry/box_grid.h"

namespace floorproof {

// What lies within this of a geom of the robot is live, and stays so until the robot has moved by
// kTrigger_m; the rest is for joints that give way beyond their limits.
constexpr double kSlack_m = 0.10, kTrigger_m = 0.08;

struct WallPool {
  BoxGrid grid;  // all walls of the map, in its grid frame
  Pose2 X_WG;
  int first_geom = -1, num = 0;  // the pool's geoms in the model, one after the other
};

// Empty (num 0) where the walls are few or all of them may be near at once. `robot` is compiled in
// a copy, to learn its reach; `assets`: the robot's files.
WallPool MakeWallPool(const std::vector<Box2>& boxes, const Pose2& X_WG, const mjSpec* robot,
                      const mjVFS* assets);

// MuJoCo's position and half sizes of a box; its yaw is the frame's.
void PlaceWall(const Box2& box, const Pose2& X_WG, mjtNum* pos, mjtNum* size);
// Of one that stands for no wall: deep below any floor.
void ParkWall(mjtNum* pos, mjtNum* size);

}  // namespace floorproof
