// SPDX-License-Identifier: Apache-2.0
// A tour of cells as the path that a robot drives.
#pragma once

#include <vector>

#include "env/core/path.h"
#include "env/core/robot_spec.h"
#include "planners/risk/risk_grid.h"
#include "planners/walk/transform_tour.h"

namespace floorproof {

// How a robot goes to each cell of a tour. Both may be empty.
struct CellMotion {
  std::vector<double> yaw_rad;    // held on the way
  std::vector<double> speed_mps;  // 0: the robot's own
};

// Waypoints from `start` over the cells' centres to end_W, in the map's frame. Points on straight
// lines are left out.
Path ToPath(const CellTour& tour, const CellMotion& motion, const GridFrame& frame,
            const Pose2& start, const Vec2& end_W);

// By cell of the tour: the robot's cover_speed_mps on the way onto, over and off terrain; else 0.
std::vector<double> SpeedsOverTerrain(const RiskGrid& grid, const std::vector<Cell>& tour,
                                      const RobotSpec& robot);

}  // namespace floorproof
