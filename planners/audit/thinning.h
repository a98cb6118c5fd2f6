// SPDX-License-Identifier: Apache-2.0
// Lines of one cell's width out of thick ones: Zhang & Suen, "A fast parallel algorithm for
// thinning digital patterns", 1984, as OpenCV has it.
#pragma once

#include <cstdint>

#include "env/geometry/grid.h"

namespace floorproof {

// Thins the set cells (not 0) to lines that are connected as they were; set cells come out as 1.
// OpenCV has it in a library that brings 140 others, so it is loaded at first use. Throws
// InternalError when it cannot be loaded or fails.
void Thin(Grid<std::uint8_t>& set);

}  // namespace floorproof
