// SPDX-License-Identifier: Apache-2.0
// The margin between cell centres is interpolated. Along a line near one obstacle the distance to
// it is convex, so interpolation makes it too large, by at most cell^2 / (4 radius). Between two
// obstacles the distance is concave, and interpolation makes it too small, which is safe.
#include "planners/lines/floor.h"

#include <algorithm>
#include <limits>

#include "env/geometry/distance.h"

namespace floorproof {

double PolylineLength(const Polyline& line) {
  double sum = 0;
  for (std::size_t i = 1; i < line.size(); ++i) sum += (line[i] - line[i - 1]).norm();
  return sum;
}

Polyline MergeStraight(const Polyline& line) {
  constexpr double kSame = 1e-6, kOff = 0.02;  // cells
  Polyline out;
  for (const Vec2& p : line) {
    if (!out.empty() && (p - out.back()).norm() < kSame) continue;
    while (out.size() >= 2 && DistanceToSegment(out[out.size() - 2], p, out.back()) < kOff)
      out.pop_back();
    out.push_back(p);
  }
  return out;
}

double Floor::MarginAt(const Vec2& p) const { return Interpolate(margin, p, -1); }

// Between cell centres a footprint is free exactly where it is free at the four centres around: in
// the plane of its poses an obstacle is a rectangle larger than a cell. So the line is looked at
// once in each square of four centres that it crosses.
bool Floor::SeesWithFootprint(const Vec2& a, const Vec2& b) const {
  const Vec2 d = b - a;
  double next[2], every[2];
  for (int k = 0; k < 2; ++k) {
    const double from = a[k] - 0.5;
    const double ahead = d[k] > 0 ? std::floor(from) + 1 - from : from - std::ceil(from) + 1;
    every[k] = d[k] != 0 ? 1 / std::abs(d[k]) : std::numeric_limits<double>::infinity();
    next[k] = d[k] != 0 ? ahead * every[k] : every[k];
  }
  for (double s = 0; s < 1;) {
    const int k = next[0] < next[1] ? 0 : 1;
    const double end = std::min(next[k], 1.0);
    if (end > s && MarginAt(a + (s + end) / 2 * d) < -tolerance) return false;
    s = end;
    next[k] += every[k];
  }
  return MarginAt(b) >= -tolerance;
}

bool Floor::Sees(const Vec2& a, const Vec2& b) const {
  if (clears_footprint) return SeesWithFootprint(a, b);
  // Where there is room to spare, the next sample may be that much farther on: a distance changes
  // by no more than the way travelled.
  constexpr double kStep = 0.5;
  const double length = (b - a).norm();
  const Vec2 dir = length > 0 ? Vec2((b - a) / length) : Vec2(0, 0);
  for (double s = 0; s < length;) {
    const double room = MarginAt(a + s * dir);
    if (room < -tolerance) return false;
    s += std::max(kStep, room - 1);
  }
  return MarginAt(b) >= -tolerance;
}

Floor CropFloor(const SweepArea& area, const Shape2& clear, const Shape2& tool, double tool_width_m,
                double overlap) {
  int x0 = area.frame.width, x1 = -1, y0 = area.frame.height, y1 = -1;
  for (int iy = 0; iy < area.frame.height; ++iy)
    for (int ix = 0; ix < area.frame.width; ++ix)
      if (area.sweepable(ix, iy) || area.reachable(ix, iy)) {
        x0 = std::min(x0, ix), x1 = std::max(x1, ix);
        y0 = std::min(y0, iy), y1 = iy;
      }
  constexpr int kBorder = 2;  // so that neighbours of the floor's cells exist
  Floor floor;
  const int w = std::max(0, x1 - x0 + 1) + 2 * kBorder, h = std::max(0, y1 - y0 + 1) + 2 * kBorder;
  const Vec2 origin((x0 - kBorder) * area.frame.cell_m, (y0 - kBorder) * area.frame.cell_m);
  floor.frame = {w, h, area.frame.cell_m, area.frame.X_WG * Pose2{origin.x(), origin.y(), 0}};
  floor.pose = floor.ground = Grid<std::uint8_t>(w, h);
  floor.margin = Grid<float>(w, h, -1);
  const bool circle = clear.kind == Shape2::Kind::kCircle;
  const double cell_m = area.frame.cell_m;
  for (int iy = y0; iy <= y1; ++iy)
    for (int ix = x0; ix <= x1; ++ix) {
      const int cx = ix - x0 + kBorder, cy = iy - y0 + kBorder;
      floor.pose(cx, cy) = area.reachable(ix, iy);
      floor.ground(cx, cy) = area.sweepable(ix, iy);
      floor.ground_cells += area.sweepable(ix, iy);
      const double room =
          circle ? (static_cast<double>(area.clearance_m(ix, iy)) - clear.radius_m) / cell_m
                 : (area.reachable(ix, iy) ? 0.0 : -1.0);
      // A clear place that is not connected to the start counts as blocked.
      floor.margin(cx, cy) =
          static_cast<float>(area.reachable(ix, iy) ? std::max(room, 0.0) : std::min(room, -0.01));
    }
  floor.tolerance = circle ? 0.25 : 1e-6;
  floor.clears_footprint = !circle;
  floor.tool = tool;
  floor.narrow = 1 - overlap;
  floor.tool_width = tool_width_m / cell_m * floor.narrow;
  floor.tool_reach = tool.radius_m / cell_m;
  double inradius = floor.tool_reach;
  if (tool.kind == Shape2::Kind::kFootprint) {
    for (const Vec2& p : tool.footprint_B)
      floor.tool_reach = std::max(floor.tool_reach, p.norm() / cell_m);
    inradius = -SignedDistance(tool.footprint_B, Vec2::Zero()) / cell_m;
  }
  // What lies within so many cells of a pose. Distances are to a pose cell's area: its centre is at
  // most half a diagonal farther.
  Grid<float> to_pose;
  const auto keep_within = [&](double reach, Grid<std::uint8_t>& mask) {
    if (to_pose.cells.empty()) to_pose = DistanceToSet(floor.pose, false);
    for (std::size_t i = 0; i < mask.cells.size(); ++i)
      if (!floor.pose.cells[i] && static_cast<double>(to_pose.cells[i]) > reach - std::sqrt(0.5))
        mask.cells[i] = 0;
  };
  floor.inner = floor.ground;
  if (overlap > 0) keep_within(floor.narrow * inradius, floor.inner);
  if (area.hidden.cells.empty()) return floor;
  floor.hidden = Grid<std::uint8_t>(w, h);
  for (int iy = y0; iy <= y1; ++iy)
    for (int ix = x0; ix <= x1; ++ix)
      floor.hidden(ix - x0 + kBorder, iy - y0 + kBorder) =
          area.hidden(ix, iy) && area.sweepable(ix, iy);
  floor.near_reach =
      (circle ? clear.radius_m : -SignedDistance(clear.footprint_B, Vec2::Zero())) / cell_m;
  keep_within(floor.near_reach, floor.hidden);
  return floor;
}

}  // namespace floorproof
