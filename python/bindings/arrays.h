// SPDX-License-Identifier: Apache-2.0
// Plain values as numpy arrays, and back.
#pragma once

#include <nanobind/ndarray.h>

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "env/core/path.h"
#include "env/geometry/grid.h"
#include "env/known/known_map.h"
#include "python/bindings/host.h"

namespace floorproof {

// Takes the values over; no copy.
template <class T>
nb::ndarray<nb::numpy, T> ArrayOf(std::vector<T> values, std::initializer_list<std::size_t> shape) {
  auto* kept = new std::vector<T>(std::move(values));
  const nb::capsule owner(kept, [](void* p) noexcept { delete static_cast<std::vector<T>*>(p); });
  return nb::ndarray<nb::numpy, T>(kept->data(), shape, owner);
}

// [height, width], row 0 the lowest: cell (ix, iy) is array[iy, ix].
template <class To, class From>
nb::ndarray<nb::numpy, To> GridArray(const Grid<From>& grid) {
  std::vector<To> values(grid.cells.size());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<To>(grid.cells[i]);
  return ArrayOf(std::move(values),
                 {static_cast<std::size_t>(grid.height), static_cast<std::size_t>(grid.width)});
}

// The same of yes and no.
inline nb::ndarray<nb::numpy, bool> MaskArray(const Grid<std::uint8_t>& mask) {
  const std::size_t n = mask.cells.size();
  auto* kept = new bool[n];
  for (std::size_t i = 0; i < n; ++i) kept[i] = mask.cells[i] != 0;
  const nb::capsule owner(kept, [](void* p) noexcept { delete[] static_cast<bool*>(p); });
  return nb::ndarray<nb::numpy, bool>(
      kept, {static_cast<std::size_t>(mask.height), static_cast<std::size_t>(mask.width)}, owner);
}

// Of a map that a robot has drawn: 0 free, 1 occupied, 2 unknown.
nb::ndarray<nb::numpy, std::uint8_t> KnownArray(const KnownMap& known);

using Rows = nb::ndarray<const double, nb::ndim<2>, nb::c_contig, nb::device::cpu>;

// [n, 5]: x_m, y_m, yaw_rad (NaN: none), speed_mps (0: the robot's cruise), dwell_s.
nb::ndarray<nb::numpy, double> PathArray(const Path& path);
// The same back, of 2 to 5 columns. `who` gave it, as errors name it. Throws InputError where the
// array has another shape, no row, a number that is not finite, a negative speed or dwell, or a
// point off the map.
Path PathFrom(const Rows& rows, const GridFrame& map, const std::string& who);

}  // namespace floorproof
