// SPDX-License-Identifier: Apache-2.0
// Polygons on grids: which cells they touch.
#pragma once

#include <functional>
#include <vector>

#include "env/geometry/polygon.h"

namespace floorproof {

// Cells of 0 .. width - 1 x 0 .. height - 1 that the polygon (in cells) touches with more than a
// border, as paint(ix, iy), some of them more than once.
void Rasterise(const Polygon& polygon, int width, int height,
               const std::function<void(int, int)>& paint);

// A footprint in cells, at the centre of cell (0, 0): spans x0 .. x1 of cells in row iy.
struct Stencil {
  struct Span {
    int iy, x0, x1;
  };
  std::vector<Span> spans;
};

// The cells that the footprint touches, or those whose centre it holds, after turns of 90 deg and
// with its edges drawn in by inset_m. inset_m must be small compared with the edges.
enum class StencilOf { kTouched, kCentres };
Stencil MakeStencil(const Polygon& footprint_B, double cell_m, int quarter_turns, double inset_m,
                    StencilOf which);

}  // namespace floorproof
