// SPDX-License-Identifier: Apache-2.0
// The walls and furniture of a map as few boxes.
#pragma once

#include <vector>

#include "env/core/hazard_map.h"
#include "env/core/robot_spec.h"
#include "env/map/wall_grid.h"

namespace floorproof {

// 1 on the free cells (not IsWall) of the map that hang together with the start's by their sides;
// on all free ones where the start's is none.
Grid<std::uint8_t> FloorAround(const HazardMap& map, const Vec2& start_W);

// Maximal rectangles of occupied cells (IsWall), one ring of cells beyond the map included, as far
// as a robot that starts there can see or touch them: those within reach (its circumscribed circle
// and 0.3 m more, so that a picture shows walls of some thickness) of the FloorAround the start. A
// lidar sees into gaps that the robot does not fit into. Faces towards free cells are drawn back by
// map.inset_m.
std::vector<WallBox> WallBoxes(const HazardMap& map, const RobotSpec& robot, const Vec2& start_W);

// Greedy cover of the set cells by rectangles that do not overlap: {ix, iy, width, height}.
struct CellRect {
  int ix = 0, iy = 0, width = 0, height = 0;
};
std::vector<CellRect> MaximalRectangles(const Grid<std::uint8_t>& set);

}  // namespace floorproof
