// SPDX-License-Identifier: Apache-2.0
// Headings at which a holonomic robot crosses terrain forward, or sideways.
#pragma once

#include <vector>

#include "planners/risk/risk_map.h"

namespace floorproof {

// Which of its sides leads over terrain: any, front or back, left or right.
enum class TerrainLead { kAny, kForward, kSideways };

// Whether plans say which way its body points: its wheels have rollers, and its footprint is what
// is kept clear.
bool HoldsYaw(const RobotSpec& robot);

// By cell of a tour, whose cells are neighbours: the quarter turn (0 to 3, from the grid's x) that
// the robot holds on its way there. It begins at `first` and turns as little as it must.
//
// It has to turn before it steps onto terrain along the axis that is not the one it leads by;
// backwards is as good as forwards. With kAny it never turns. It does so after the last terrain
// that it crossed, in a cell with room: one whose four neighbours are not solid. It takes the last
// such cell where the way bends anyway, else the last such cell. Where no cell has room, it crosses
// as it is.
std::vector<int> QuartersOverTerrain(const RiskGrid& grid, const std::vector<Cell>& tour, int first,
                                     TerrainLead lead);

}  // namespace floorproof
