// SPDX-License-Identifier: Apache-2.0
// Contours are traced along the cracks between cells inside a mask and cells outside, each crack
// once, with the mask to the left. So every contour closes, whatever the mask looks like. On a
// contour at depth 0 the robot's clear shape slides along the wall.
#include "planners/lines/wall_contours.h"

#include <algorithm>
#include <array>

#include "env/geometry/distance.h"

namespace floorproof {
namespace {

// The points of `chain` from i to j reduced as by Douglas & Peucker 1973. In addition the robot
// must be able to drive each segment that results.
void Reduce(const Floor& floor, const Polyline& chain, std::size_t i, std::size_t j,
            double tolerance, Polyline& out) {
  std::vector<std::pair<std::size_t, std::size_t>> stack = {{i, j}};
  while (!stack.empty()) {
    const auto [a, b] = stack.back();
    stack.pop_back();
    std::size_t worst = a;
    double far = tolerance;
    for (std::size_t k = a + 1; k < b; ++k) {
      const double d = DistanceToSegment(chain[a], chain[b], chain[k]);
      if (d > far) far = d, worst = k;
    }
    if (worst == a && b > a + 1 && !floor.Sees(chain[a], chain[b])) worst = (a + b) / 2;
    if (worst == a) {
      out.push_back(chain[b]);
    } else {
      stack.push_back({worst, b});
      stack.push_back({a, worst});
    }
  }
}

}  // namespace

Grid<float> PoseDepth(const Floor& floor) {
  Grid<std::uint8_t> blocked(floor.frame.width, floor.frame.height);
  for (std::size_t i = 0; i < blocked.cells.size(); ++i) blocked.cells[i] = !floor.pose.cells[i];
  return DistanceToSet(blocked, true);
}

std::vector<Polyline> Contours(const Floor& floor, const Grid<float>& depth, double least_depth) {
  const int w = depth.width, h = depth.height;
  const auto in = [&](int ix, int iy) {
    return floor.pose.Inside(ix, iy) && floor.pose(ix, iy) &&
           static_cast<double>(depth(ix, iy)) > least_depth;
  };
  // A crack is named by the cell inside and the side (0 right, 1 top, 2 left, 3 bottom) it is on.
  constexpr std::array<Cell, 4> kOut = {Cell{1, 0}, Cell{0, 1}, Cell{-1, 0}, Cell{0, -1}};
  Grid<std::uint8_t> seen(w, h);
  std::vector<Polyline> contours;
  for (int iy = 0; iy < h; ++iy)
    for (int ix = 0; ix < w; ++ix) {
      if (!in(ix, iy)) continue;
      for (unsigned first = 0; first < 4; ++first) {
        if (in(ix + kOut[first].ix, iy + kOut[first].iy) || (seen(ix, iy) >> first & 1)) continue;
        Polyline contour;
        Cell c{ix, iy};
        unsigned side = first;
        do {
          seen(c) = static_cast<std::uint8_t>(seen(c) | 1u << side);
          const Vec2 p = Floor::CentreOf(c);
          if (contour.empty() || contour.back() != p) contour.push_back(p);
          // Walk with the inside to the left: ahead is the next side counter-clockwise.
          const Cell ahead = kOut[(side + 1) % 4], out = kOut[side];
          const Cell diagonal{c.ix + ahead.ix + out.ix, c.iy + ahead.iy + out.iy};
          const Cell straight{c.ix + ahead.ix, c.iy + ahead.iy};
          // A footprint slides round a corner cell by cell: aslant it would scrape.
          const bool by_cells = floor.clears_footprint;
          if (in(diagonal.ix, diagonal.iy) && (!by_cells || in(straight.ix, straight.iy))) {
            if (by_cells) contour.push_back(Floor::CentreOf(straight));
            c = diagonal;
            side = (side + 3) % 4;
          } else if (in(straight.ix, straight.iy)) {
            c = straight;
          } else {
            side = (side + 1) % 4;
          }
        } while (c.ix != ix || c.iy != iy || side != first);
        if (contour.size() > 1 && contour.back() != contour.front())
          contour.push_back(contour.front());
        contours.push_back(std::move(contour));
      }
    }
  return contours;
}

Polyline Simplify(const Floor& floor, const Polyline& line, double tolerance) {
  if (line.size() < 3) return line;
  Polyline out = {line.front()};
  if (line.front() == line.back()) {  // a closed line has no chord to measure from
    std::size_t far = 0;
    double most = 0;
    for (std::size_t i = 0; i < line.size(); ++i)
      if (const double d = (line[i] - line[0]).norm(); d > most) most = d, far = i;
    if (far == 0) return {line.front()};
    Reduce(floor, line, 0, far, tolerance, out);
    Reduce(floor, line, far, line.size() - 1, tolerance, out);
  } else {
    Reduce(floor, line, 0, line.size() - 1, tolerance, out);
  }
  return out;
}

std::vector<Polyline> OpenParts(const Floor& floor, const std::vector<Polyline>& lines,
                                double share, double min_gain, double tolerance, Swept& swept) {
  constexpr std::ptrdiff_t kTangent = 3;  // points either way
  std::vector<Polyline> parts;
  for (const Polyline& line : lines) {
    const auto n = static_cast<std::ptrdiff_t>(line.size());
    const auto at = [&](std::ptrdiff_t i) { return line[static_cast<std::size_t>(i)]; };
    const auto open_at = [&](std::ptrdiff_t i) {
      const Vec2 way =
          at(std::min(n - 1, i + kTangent)) - at(std::max<std::ptrdiff_t>(0, i - kTangent));
      const double length = way.norm();
      const Vec2 across = length > 0 ? Vec2(-way.y() / length, way.x() / length) : Vec2(0, 1);
      return swept.OpenShareAcross(at(i), across) >= share;
    };
    const double bridge = 1.5 * floor.tool_width;
    for (std::ptrdiff_t i = 0; i < n;) {
      if (!open_at(i)) {
        ++i;
        continue;
      }
      std::ptrdiff_t last = i;
      double gap = 0;
      for (std::ptrdiff_t k = i + 1; k < n && gap <= bridge; ++k) {
        gap += (at(k) - at(k - 1)).norm();
        if (open_at(k)) last = k, gap = 0;
      }
      const Polyline part =
          Simplify(floor, Polyline(line.begin() + i, line.begin() + last + 1), tolerance);
      const int gain = swept.Add(part);
      if (gain >= min_gain) {
        parts.push_back(part);
      } else {
        swept.Remove(part);
      }
      i = last + 1;
    }
  }
  return parts;
}

}  // namespace floorproof
