// SPDX-License-Identifier: Apache-2.0
// Steps from a cell to its neighbours.
#pragma once

#include <array>

#include "env/geometry/grid.h"

namespace floorproof {

// The FMEA paper's T directions, in its order: up, down, right, left.
inline constexpr std::array<Cell, 4> kSideSteps = {Cell{0, 1}, Cell{0, -1}, Cell{1, 0},
                                                   Cell{-1, 0}};
// Its X directions: up-right, right-down, down-left, left-up.
inline constexpr std::array<Cell, 4> kCornerSteps = {Cell{1, 1}, Cell{1, -1}, Cell{-1, -1},
                                                     Cell{-1, 1}};

inline Cell operator+(Cell a, Cell b) { return {a.ix + b.ix, a.iy + b.iy}; }

}  // namespace floorproof
