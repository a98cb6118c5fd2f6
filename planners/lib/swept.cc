// SPDX-License-Identifier: Apache-2.0
// A tool that moves straight without turning sweeps the convex hull of its two ends: a capsule for
// a disc; a footprint (held at the frame's yaw) is taken as its convex hull.
#include "planners/lib/swept.h"

#include <algorithm>
#include <limits>

namespace floorproof {

Swept::Swept(const Floor& floor) : floor_(&floor), count_(floor.frame.width, floor.frame.height) {
  if (floor.tool.kind == Shape2::Kind::kFootprint) {
    tool_ = ConvexHull(floor.tool.footprint_B);
    for (Vec2& p : tool_) p /= floor.frame.cell_m;
  }
}

int Swept::Add(const Polyline& line) {
  int changed = line.size() == 1 ? Add(line[0], line[0]) : 0;
  for (std::size_t i = 1; i < line.size(); ++i) changed += Add(line[i - 1], line[i]);
  return changed;
}

int Swept::Remove(const Polyline& line) {
  int changed = line.size() == 1 ? Remove(line[0], line[0]) : 0;
  for (std::size_t i = 1; i < line.size(); ++i) changed += Remove(line[i - 1], line[i]);
  return changed;
}

int Swept::Gain(const Polyline& line) {
  const int gain = Add(line);
  Remove(line);
  return gain;
}

void Swept::Span(int iy, double low, double high, int by, int& changed) {
  const int x0 = static_cast<int>(std::ceil(std::clamp(low - 0.5, 0.0, count_.width + 0.0)));
  const int x1 = static_cast<int>(std::floor(std::clamp(high - 0.5, -1.0, count_.width - 1.0)));
  for (int ix = x0; ix <= x1; ++ix) {
    std::uint16_t& n = count_(ix, iy);
    if (by > 0 ? n++ == 0 : --n == 0)
      if (floor_->ground(ix, iy)) ++changed;
  }
}

int Swept::Change(const Vec2& from, const Vec2& to, int by) {
  // One order for both ways, so that what was added one way can be taken back the other.
  const bool swap = to.x() < from.x() || (to.x() == from.x() && to.y() < from.y());
  const Vec2 &a = swap ? to : from, &b = swap ? from : to;
  const double inf = std::numeric_limits<double>::infinity();
  const double r = floor_->tool_reach + 1e-6;  // the rim counts, as in ComputeSweepArea
  const bool disc = tool_.empty();
  const Vec2 way = b - a;
  const double length = way.norm();
  const Vec2 dir = length > 0 ? Vec2(way / length) : Vec2(1, 0), side(-dir.y(), dir.x());
  Polygon hull;
  if (!disc) {
    for (const Vec2& p : tool_) hull.push_back(a + p), hull.push_back(b + p);
    hull = ConvexHull(hull);
  }
  int changed = 0;
  const int y0 = std::max(0, static_cast<int>(std::floor(std::min(a.y(), b.y()) - r)));
  const int y1 =
      std::min(count_.height - 1, static_cast<int>(std::floor(std::max(a.y(), b.y()) + r)));
  for (int iy = y0; iy <= y1; ++iy) {
    const double y = iy + 0.5;
    double low = inf, high = -inf;
    const auto edge = [&](const Vec2& p, const Vec2& q) {  // where the line pq crosses this row
      if ((p.y() <= y) == (q.y() <= y)) return;
      const double x = p.x() + (y - p.y()) / (q.y() - p.y()) * (q.x() - p.x());
      low = std::min(low, x), high = std::max(high, x);
    };
    if (disc) {
      for (const Vec2& c : {a, b}) {
        const double h2 = r * r - (y - c.y()) * (y - c.y());
        if (h2 < 0) continue;
        const double h = std::sqrt(h2);
        low = std::min(low, c.x() - h), high = std::max(high, c.x() + h);
      }
      edge(a + r * side, b + r * side);
      edge(a - r * side, b - r * side);
      edge(a + r * side, a - r * side);
      edge(b + r * side, b - r * side);
    } else {
      for (std::size_t k = 0; k < hull.size(); ++k) edge(hull[k], hull[(k + 1) % hull.size()]);
    }
    if (low <= high) Span(iy, low, high, by, changed);
  }
  swept_ += by > 0 ? changed : -changed;
  return changed;
}

}  // namespace floorproof
