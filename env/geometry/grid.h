// SPDX-License-Identifier: Apache-2.0
// Cell layers and where their cells lie in the world.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "env/geometry/geometry.h"

namespace floorproof {

struct Cell {
  int ix = 0, iy = 0;
  bool operator==(const Cell&) const = default;
};

// What a map says of a cell.
enum class CellState : std::uint8_t { kFree = 0, kOccupied = 1, kUnknown = 2 };

// width x height values, row by row from the lowest; cell (0, 0) is the lower left, as in ROS maps.
template <class T>
struct Grid {
  int width = 0, height = 0;
  std::vector<T> cells;

  Grid() = default;
  Grid(int w, int h, T value = T{})
      : width(w),
        height(h),
        cells(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), value) {}

  bool Inside(int ix, int iy) const { return ix >= 0 && iy >= 0 && ix < width && iy < height; }
  bool Inside(Cell c) const { return Inside(c.ix, c.iy); }
  std::size_t Index(int ix, int iy) const {
    return static_cast<std::size_t>(iy) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(ix);
  }
  T& operator()(int ix, int iy) { return cells[Index(ix, iy)]; }
  const T& operator()(int ix, int iy) const { return cells[Index(ix, iy)]; }
  T& operator()(Cell c) { return cells[Index(c.ix, c.iy)]; }
  const T& operator()(Cell c) const { return cells[Index(c.ix, c.iy)]; }
};

// Frame G of a grid: origin at the outer lower-left corner of cell (0, 0), x along a row.
struct GridFrame {
  int width = 0, height = 0;
  double cell_m = 0.05;
  Pose2 X_WG;

  Vec2 ToGrid(const Vec2& p_W) const { return X_WG.InverseTimes(p_W); }  // p_G, in m
  // The cell that holds p_W; it may lie outside the grid. For points that are very far away or not
  // finite, only that much is right: the cell lies outside.
  Cell ToCell(const Vec2& p_W) const {
    const Vec2 p_G = ToGrid(p_W);
    const auto index = [this](double along_m) {
      const double i = std::floor(along_m / cell_m);
      constexpr double kFar = 1e9;
      return static_cast<int>(i > -kFar ? (i < kFar ? i : kFar) : -kFar);  // NaN: -kFar
    };
    return {index(p_G.x()), index(p_G.y())};
  }
  Vec2 Center(int ix, int iy) const {
    return X_WG * Vec2((ix + 0.5) * cell_m, (iy + 0.5) * cell_m);
  }
  Vec2 Center(Cell c) const { return Center(c.ix, c.iy); }
  bool Inside(Cell c) const { return c.ix >= 0 && c.iy >= 0 && c.ix < width && c.iy < height; }
  // The same ground in cells of cell_m / k.
  GridFrame Subdivided(int k) const { return {width * k, height * k, cell_m / k, X_WG}; }
};

}  // namespace floorproof
