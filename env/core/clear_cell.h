// SPDX-License-Identifier: Apache-2.0
// The cell that a place counts as.
#pragma once

#include <cstdint>
#include <optional>

#include "env/geometry/geometry.h"
#include "env/geometry/grid.h"

namespace floorproof {

// The clear cell at `c`, or else the clear neighbour whose centre is nearest to p_G (in cells): a
// clear place may lie in a cell whose centre is just not clear.
std::optional<Cell> ClearCellAt(const Grid<std::uint8_t>& free, Cell c, const Vec2& p_G);

}  // namespace floorproof
