// SPDX-License-Identifier: Apache-2.0
// Cells, vertices and places are numbered with ints, -1 meaning none. Numbers as indices, and back.
#pragma once

#include <cstddef>

#include "env/geometry/grid.h"

namespace floorproof {

// A number, never negative, as the index of a vector.
constexpr std::size_t Z(int i) { return static_cast<std::size_t>(i); }

// A cell's number in its grid: its index in `cells`.
template <class T>
int NumberOf(const Grid<T>& grid, Cell c) {
  return c.iy * grid.width + c.ix;
}

template <class T>
Cell CellAt(const Grid<T>& grid, std::size_t index) {
  const auto width = static_cast<std::size_t>(grid.width);
  return {static_cast<int>(index % width), static_cast<int>(index / width)};
}

}  // namespace floorproof
