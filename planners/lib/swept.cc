// SPDX-License-Identifier: Apache-2.0
// A tool that moves straight without turning sweeps the convex hull of its two ends: a capsule for
// a disc; a footprint (held at the frame's yaw) is taken as its convex hull.
#include "planners/lib/swept.h"

#include <algorithm>
#include <limits>

namespace floorproof {
namespace {

constexpr double kRim = 1e-6;  // cells: the rim counts, as in ComputeSweepArea

}  // namespace

Swept::Swept(const Floor& floor) : floor_(&floor), count_(floor.frame.width, floor.frame.height) {
  // What is no ground counts as swept from the first, and so never changes.
  for (std::size_t i = 0; i < count_.cells.size(); ++i) count_.cells[i] = !floor.ground.cells[i];
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

double Swept::OpenShareAcross(const Vec2& p, const Vec2& across) const {
  const double width = floor_->tool_width;
  const int n = std::max(1, static_cast<int>(std::lround(width)));
  int open = 0;
  for (int i = 0; i < n; ++i) {
    const Cell c = Floor::CellAt(p + ((i + 0.5) / n - 0.5) * width * across);
    if (count_.Inside(c) && IsOpen(c.ix, c.iy)) ++open;
  }
  return static_cast<double>(open) / n;
}

int Swept::Span(int iy, double low, double high, int by) {
  const int x0 = static_cast<int>(std::ceil(std::max(0.0, low - 0.5)));
  const int x1 = std::min(count_.width - 1, static_cast<int>(std::floor(high - 0.5)));
  int changed = 0;
  std::uint16_t* row = &count_.cells[count_.Index(0, iy)];
  if (by > 0) {
    for (int ix = x0; ix <= x1; ++ix) changed += row[ix]++ == 0;
  } else {
    for (int ix = x0; ix <= x1; ++ix) changed += --row[ix] == 0;
  }
  return changed;
}

int Swept::Change(const Vec2& from, const Vec2& to, int by) {
  // One order for both ways, so that what was added one way can be taken back the other.
  const bool swap = to.x() < from.x() || (to.x() == from.x() && to.y() < from.y());
  const Vec2 &a = swap ? to : from, &b = swap ? from : to;
  const int changed = tool_.empty() ? ChangeDisc(a, b, by) : ChangeFootprint(a, b, by);
  swept_ += by > 0 ? changed : -changed;
  return changed;
}

std::pair<int, int> Swept::RowsNear(const Vec2& a, const Vec2& b) const {
  const double r = floor_->tool_reach + 1;
  return {std::max(0, static_cast<int>(std::min(a.y(), b.y()) - r)),
          std::min(count_.height - 1, static_cast<int>(std::max(a.y(), b.y()) + r))};
}

int Swept::ChangeDisc(const Vec2& a, const Vec2& b, int by) {
  const double r = floor_->tool_reach + kRim;
  const Vec2 way = b - a;
  const double length = way.norm();
  // The strip between the ends has two long sides, offset by +-side; its short ones lie within the
  // discs. Where a row crosses a long side: x = a.x + side.x + (y - a.y - side.y) * slope.
  const Vec2 side = length > 0 ? Vec2(-way.y() / length * r, way.x() / length * r) : Vec2(0, 0);
  const double slope = way.y() != 0 ? way.x() / way.y() : 0;
  int changed = 0;
  const auto [y0, y1] = RowsNear(a, b);
  for (int iy = y0; iy <= y1; ++iy) {
    const double y = iy + 0.5, da = y - a.y(), db = y - b.y();
    double low = std::numeric_limits<double>::infinity(), high = -low;
    if (const double h2 = r * r - da * da; h2 >= 0) {
      const double h = std::sqrt(h2);
      low = a.x() - h, high = a.x() + h;
    }
    if (const double h2 = r * r - db * db; h2 >= 0) {
      const double h = std::sqrt(h2);
      low = std::min(low, b.x() - h), high = std::max(high, b.x() + h);
    }
    if ((da <= side.y()) != (db <= side.y())) {
      const double x = a.x() + side.x() + (da - side.y()) * slope;
      low = std::min(low, x), high = std::max(high, x);
    }
    if ((da <= -side.y()) != (db <= -side.y())) {
      const double x = a.x() - side.x() + (da + side.y()) * slope;
      low = std::min(low, x), high = std::max(high, x);
    }
    if (low <= high) changed += Span(iy, low, high, by);
  }
  return changed;
}

int Swept::ChangeFootprint(const Vec2& a, const Vec2& b, int by) {
  Polygon hull;
  for (const Vec2& p : tool_) hull.push_back(a + p), hull.push_back(b + p);
  hull = ConvexHull(hull);
  int changed = 0;
  const auto [y0, y1] = RowsNear(a, b);
  for (int iy = y0; iy <= y1; ++iy) {
    const double y = iy + 0.5;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t k = 0; k < hull.size(); ++k) {
      const Vec2 &p = hull[k], &q = hull[(k + 1) % hull.size()];
      if ((p.y() <= y) == (q.y() <= y)) continue;
      const double x = p.x() + (y - p.y()) / (q.y() - p.y()) * (q.x() - p.x());
      low = std::min(low, x), high = std::max(high, x);
    }
    if (low <= high) changed += Span(iy, low - kRim, high + kRim, by);
  }
  return changed;
}

}  // namespace floorproof
