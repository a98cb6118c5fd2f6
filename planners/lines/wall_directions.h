// SPDX-License-Identifier: Apache-2.0
// In which directions the walls of a floor run.
#pragma once

#include <cstdint>
#include <vector>

#include "env/geometry/grid.h"

namespace floorproof {

constexpr int kMaxDirections = 6;

// Up to kMaxDirections peaks of the histogram of the walls' directions, strongest first, in [0, pi
// / 2): in the grid's axes, modulo 90 deg, to a degree. `room`: the margin to the nearest wall in
// cells, below 1 where a cell does not count. One direction of 0 where there are no walls.
std::vector<double> WallDirections(const Grid<float>& room);

// The direction of most of the walls' borders, to a tenth of a degree, in (-pi / 4, pi / 4], in the
// grid's axes modulo 90 deg; 0 unless they line up with it plainly better than with the axes.
double MainWallDirection(const Grid<std::uint8_t>& walls);

}  // namespace floorproof
