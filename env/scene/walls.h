// SPDX-License-Identifier: Apache-2.0
// The walls and furniture of a map as few boxes.
#pragma once

#include <vector>

#include "env/core/hazard_map.h"
#include "env/core/robot_spec.h"
#include "env/geometry/box.h"

namespace floorproof {

constexpr double kWallHeight_m = 0.45;  // of the boxes, from the base floor up

// 1 on the free cells (not IsWall) of the map that are connected with the start's cell by their
// sides. If the start's cell is not free, 1 on all free cells.
Grid<std::uint8_t> FloorAround(const HazardMap& map, const Vec2& start_W);

// Maximal rectangles of occupied cells (IsWall), including one ring of cells beyond the map. Only
// walls that a robot that starts there can see or touch are included: those within reach of the
// FloorAround the start, where reach is its circumscribed circle and 0.3 m more, so that walls on a
// picture have some thickness. (A lidar sees into gaps that the robot does not fit into.) Faces
// towards free cells are drawn back by map.inset_m. In the map's grid frame G, m.
std::vector<Box2> WallBoxes(const HazardMap& map, const RobotSpec& robot, const Vec2& start_W);

// Greedy cover of the set cells by rectangles that do not overlap: {ix, iy, width, height}.
struct CellRect {
  int ix = 0, iy = 0, width = 0, height = 0;
};
std::vector<CellRect> MaximalRectangles(const Grid<std::uint8_t>& set);

}  // namespace floorproof
