// SPDX-License-Identifier: Apache-2.0
#include "env/geometry/rasterise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "env/geometry/grid.h"

namespace floorproof {
namespace {

constexpr double kEps = 1e-6;  // of a cell: borders that coincide do not touch

// Edges moved inwards by d; meant for d small against the edges.
Polygon DrawnBack(const Polygon& polygon, double d) {
  Polygon out;
  const std::size_t n = polygon.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 in = (polygon[k] - polygon[(k + n - 1) % n]).normalized();
    const Vec2 on = (polygon[(k + 1) % n] - polygon[k]).normalized();
    const Vec2 normals = Vec2(-in.y() - on.y(), in.x() + on.x());
    out.push_back(polygon[k] + d * normals / std::max(0.1, 1 + in.dot(on)));
  }
  return out;
}

}  // namespace

// Those that an edge crosses, and those whose centre lies inside.
void Rasterise(const Polygon& polygon, int width, int height,
               const std::function<void(int, int)>& paint) {
  const std::size_t n = polygon.size();
  const auto clamp = [](double v, int limit) {
    return static_cast<int>(std::clamp(v, -1.0, limit + 0.0));
  };
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 a = polygon[k], d = polygon[(k + 1) % n] - a;
    const Vec2 low = a.cwiseMin(a + d), high = a.cwiseMax(a + d);
    const int x1 = std::min(clamp(std::floor(high.x()), width), width - 1);
    const int y1 = std::min(clamp(std::floor(high.y()), height), height - 1);
    for (int iy = std::max(0, clamp(std::floor(low.y()), height)); iy <= y1; ++iy) {
      for (int ix = std::max(0, clamp(std::floor(low.x()), width)); ix <= x1; ++ix) {
        // Clip the edge to the cell's interior (Liang & Barsky 1984).
        double t0 = 0, t1 = 1;
        for (int axis = 0; axis < 2; ++axis) {
          const double near = (axis ? iy : ix) + kEps - a[axis];
          const double far = (axis ? iy : ix) + 1 - kEps - a[axis];
          if (std::abs(d[axis]) < 1e-12) {
            if (near > 0 || far < 0) t1 = -1;
            continue;
          }
          const double u = near / d[axis], v = far / d[axis];
          t0 = std::max(t0, std::min(u, v));
          t1 = std::min(t1, std::max(u, v));
        }
        if (t0 <= t1) paint(ix, iy);
      }
    }
  }
  double y_low = std::numeric_limits<double>::infinity(), y_high = -y_low;
  for (const Vec2& p : polygon) y_low = std::min(y_low, p.y()), y_high = std::max(y_high, p.y());
  const int last = std::min(clamp(std::floor(y_high), height), height - 1);
  std::vector<double> crossings;
  for (int iy = std::max(0, clamp(std::floor(y_low), height)); iy <= last; ++iy) {
    const double y = iy + 0.5;
    crossings.clear();
    for (std::size_t k = 0; k < n; ++k) {
      const Vec2 &a = polygon[k], &b = polygon[(k + 1) % n];
      if ((a.y() <= y) == (b.y() <= y)) continue;
      crossings.push_back(a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
    }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) {
      const int from = std::max(0, clamp(std::ceil(crossings[k] - 0.5 + kEps), width));
      const int to = std::min(clamp(std::floor(crossings[k + 1] - 0.5 - kEps), width), width - 1);
      for (int ix = from; ix <= to; ++ix) paint(ix, iy);
    }
  }
}

Stencil MakeStencil(const Polygon& footprint_B, double cell_m, int quarter_turns, double inset_m,
                    StencilOf which) {
  Polygon polygon = inset_m > 0 ? DrawnBack(footprint_B, inset_m) : footprint_B;
  double reach = 1;
  const std::array<Pose2, 4> turns = {Pose2{0, 0, 0}, Pose2{0, 0, kPi / 2}, Pose2{0, 0, kPi},
                                      Pose2{0, 0, -kPi / 2}};
  for (Vec2& p : polygon) {
    p = turns[static_cast<std::size_t>(quarter_turns)] * p / cell_m;
    reach = std::max(reach, p.norm());
  }
  const int half = static_cast<int>(std::ceil(reach)) + 1, size = 2 * half + 1;
  Grid<std::uint8_t> touched(size, size);
  for (Vec2& p : polygon) p += Vec2(half + 0.5, half + 0.5);
  if (which == StencilOf::kCentres) {
    for (int iy = 0; iy < size; ++iy)
      for (int ix = 0; ix < size; ++ix)
        touched(ix, iy) = SignedDistance(polygon, Vec2(ix + 0.5, iy + 0.5)) <= kEps;
  } else {
    Rasterise(polygon, size, size, [&](int ix, int iy) { touched(ix, iy) = 1; });
  }
  Stencil stencil;
  for (int iy = 0; iy < size; ++iy)
    for (int ix = 0; ix < size; ++ix) {
      if (!touched(ix, iy) || (ix > 0 && touched(ix - 1, iy))) continue;
      int end = ix;
      while (end + 1 < size && touched(end + 1, iy)) ++end;
      stencil.spans.push_back({iy - half, ix - half, end - half});
    }
  return stencil;
}

}  // namespace floorproof
