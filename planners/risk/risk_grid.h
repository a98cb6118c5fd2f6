// SPDX-License-Identifier: Apache-2.0
// A floor in cells as wide as a robot, each with what it holds. Risk is summed over these cells,
// and planners by risk go from one to the next.
//
// The FMEA paper draws its sites in such cells. The rule by which any map comes to them:
//  - If the map's own cells are at least as wide as the robot, they are the cells. A map's cell
//  that
//    is several times as wide is cut into equal parts.
//  - Else a cell is as many of the map's (of 0.05 m at most) as the robot needs. The lattice is
//    placed, to one of the map's cells, where most of its cells are free of walls. Of several such
//    places it takes the one with the lowest x, then y.
//  - A cell that overlaps a hazard's footprint holds that hazard; a common border is not enough.
//    One that overlaps anything occupied holds a blind object. What shapes the floor (C3, C4) is
//    not in a cell that is wall as a whole. Of several hazards a cell holds the one of the greatest
//    weight (FmeaTables), and it is solid if one of them is.
//  - A cell that reaches beyond the map, or that overlaps an unknown cell which counts as wall, is
//    outer wall unless it holds a hazard. So is the outermost ring of cells if all of it is wall.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "base/params.h"
#include "env/core/hazard_map.h"
#include "env/core/robot_spec.h"
#include "planners/risk/fmea_tables.h"

namespace floorproof {

struct RiskCell {
  std::optional<HazardClass> hazard;  // none: free, or outer wall
  bool solid = false;                 // C1, C2, C3 and outer walls: never driven on
  bool drivable() const { return !solid; }
  bool free() const { return !hazard && !solid; }
  bool terrain() const { return hazard && !solid; }  // C4 alone: can be crossed
  bool outer_wall() const { return !hazard && solid; }
};

struct RiskGrid {
  GridFrame frame;
  Grid<RiskCell> contents;        // of each cell
  bool walled_all_round = false;  // the outermost ring is outer wall
};

// 1 on the cells that are so: CellsThat(grid, &RiskCell::terrain).
template <class Are>
Grid<std::uint8_t> CellsThat(const RiskGrid& grid, const Are& are) {
  Grid<std::uint8_t> found(grid.contents.width, grid.contents.height);
  for (std::size_t i = 0; i < found.cells.size(); ++i)
    found.cells[i] = std::invoke(are, grid.contents.cells[i]);
  return found;
}

// The narrowest cells in which the robot can move from neighbour to neighbour, m: its clear
// circle's diameter, or the greater side of its clear footprint.
double LeastCellWidth(const RobotSpec& robot);

// `cell_m`: the width asked for; none: as wide as the robot. Rounded up to what the rule allows.
RiskGrid MakeRiskGrid(const HazardMap& map, const RobotSpec& robot, const FmeaTables& tables,
                      std::optional<double> cell_m);

}  // namespace floorproof
