// SPDX-License-Identifier: Apache-2.0
// A grid's values between the centres of its cells.
#pragma once

#include "env/geometry/geometry.h"
#include "env/geometry/grid.h"

namespace floorproof {

// As std::floor, which is a call where the processor is any x86-64.
inline int RoundDown(double x) {
  const int i = static_cast<int>(x);
  return i - (x < i);
}

// At p, in cells: bilinear between the four centres around it; `outside` where they are not all in
// the grid. Of a distance, the value at the nearest centre would be off by up to 0.7 cells.
inline double Interpolate(const Grid<float>& grid, const Vec2& p, double outside) {
  const double x = p.x() - 0.5, y = p.y() - 0.5;
  const int ix = RoundDown(x), iy = RoundDown(y);
  if (ix < 0 || iy < 0 || ix + 1 >= grid.width || iy + 1 >= grid.height) return outside;
  const float* row = &grid.cells[grid.Index(ix, iy)];
  const float* above = row + grid.width;
  const double u = x - ix, v = y - iy;
  const double low = (1 - u) * static_cast<double>(row[0]) + u * static_cast<double>(row[1]);
  const double high = (1 - u) * static_cast<double>(above[0]) + u * static_cast<double>(above[1]);
  return (1 - v) * low + v * high;
}

}  // namespace floorproof
