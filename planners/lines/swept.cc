// SPDX-License-Identifier: Apache-2.0
// A tool that moves straight and does not turn sweeps the convex hull of where it begins and ends.
// For a disc that is a capsule. A footprint is held at the frame's yaw and taken as its convex
// hull.
#include "planners/lines/swept.h"

#include <algorithm>
#include <limits>

namespace floorproof {
namespace {

constexpr int kTile = 16;      // cells
constexpr double kRim = 1e-6;  // cells: the rim counts, as in ComputeSweepArea

}  // namespace

Swept::Swept(const Floor& floor) : floor_(&floor) {
  layers_.push_back(MakeLayer(floor.narrow, floor.inner));
  if (floor.narrow < 1) {
    Grid<std::uint8_t> rim = floor.ground;
    for (std::size_t i = 0; i < rim.cells.size(); ++i) rim.cells[i] &= !floor.inner.cells[i];
    layers_.push_back(MakeLayer(1, rim));
  }
}

Swept::Layer Swept::MakeLayer(double scale, const Grid<std::uint8_t>& mask) const {
  Layer layer;
  layer.reach = scale * floor_->tool_reach;
  if (floor_->tool.kind == Shape2::Kind::kFootprint) {
    layer.tool = ConvexHull(floor_->tool.footprint_B);
    for (Vec2& p : layer.tool) p *= scale / floor_->frame.cell_m;
  }
  layer.count = Grid<std::uint16_t>(mask.width, mask.height);
  layer.tiles = Grid<std::uint8_t>(mask.width / kTile + 1, mask.height / kTile + 1);
  for (int iy = 0; iy < mask.height; ++iy)
    for (int ix = 0; ix < mask.width; ++ix) {
      layer.count(ix, iy) = !mask(ix, iy);
      layer.tiles(ix / kTile, iy / kTile) |= mask(ix, iy);
    }
  return layer;
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

double Swept::OpenShareAcross(const Vec2& p, const Vec2& across) const {
  const double width = floor_->tool_width;
  const int n = std::max(1, static_cast<int>(std::lround(width)));
  int open = 0;
  for (int i = 0; i < n; ++i) {
    const Cell c = Floor::CellAt(p + ((i + 0.5) / n - 0.5) * width * across);
    if (floor_->ground.Inside(c) && IsOpen(c.ix, c.iy)) ++open;
  }
  return static_cast<double>(open) / n;
}

int Swept::Span(Layer& layer, int iy, double low, double high, int by) {
  const int x0 = static_cast<int>(std::ceil(std::max(0.0, low - 0.5)));
  const int x1 = std::min(layer.count.width - 1, static_cast<int>(std::floor(high - 0.5)));
  if (x1 < x0) return 0;
  const std::uint8_t* tile = &layer.tiles.cells[layer.tiles.Index(x0 / kTile, iy / kTile)];
  bool any = false;
  for (int t = x0 / kTile; t <= x1 / kTile; ++t) any = any || *tile++;
  if (!any) return 0;
  int changed = 0;
  std::uint16_t* row = &layer.count.cells[layer.count.Index(0, iy)];
  if (by > 0) {
    for (int ix = x0; ix <= x1; ++ix) changed += row[ix]++ == 0;
  } else {
    for (int ix = x0; ix <= x1; ++ix) changed += --row[ix] == 0;
  }
  return changed;
}

int Swept::Change(const Vec2& from, const Vec2& to, int by) {
  int changed = 0;
  for (Layer& layer : layers_) changed += Change(layer, from, to, by);
  swept_ += by > 0 ? changed : -changed;
  return changed;
}

int Swept::Change(Layer& layer, const Vec2& from, const Vec2& to, int by) {
  // One order for both ways, so that what was added one way can be taken back the other.
  const bool swap = to.x() < from.x() || (to.x() == from.x() && to.y() < from.y());
  const Vec2 &a = swap ? to : from, &b = swap ? from : to;
  return layer.tool.empty() ? ChangeDisc(layer, a, b, by) : ChangeFootprint(layer, a, b, by);
}

int Swept::ChangeDisc(Layer& layer, const Vec2& a, const Vec2& b, int by) {
  const double r = layer.reach + kRim;
  const Vec2 way = b - a;
  const double length = way.norm();
  // The strip between the ends has two long sides, offset by +-side; its short ones lie within the
  // discs. Where a row crosses a long side: x = a.x + side.x + (y - a.y - side.y) * slope.
  const Vec2 side = length > 0 ? Vec2(-way.y() / length * r, way.x() / length * r) : Vec2(0, 0);
  const double slope = way.y() != 0 ? way.x() / way.y() : 0;
  int changed = 0;
  const int y0 = std::max(0, static_cast<int>(std::min(a.y(), b.y()) - layer.reach - 1));
  const int y1 =
      std::min(layer.count.height - 1, static_cast<int>(std::max(a.y(), b.y()) + layer.reach + 1));
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
    if (low <= high) changed += Span(layer, iy, low, high, by);
  }
  return changed;
}

int Swept::ChangeFootprint(Layer& layer, const Vec2& a, const Vec2& b, int by) {
  Polygon hull;
  for (const Vec2& p : layer.tool) hull.push_back(a + p), hull.push_back(b + p);
  hull = ConvexHull(hull);
  int changed = 0;
  const int y0 = std::max(0, static_cast<int>(std::min(a.y(), b.y()) - layer.reach - 1));
  const int y1 =
      std::min(layer.count.height - 1, static_cast<int>(std::max(a.y(), b.y()) + layer.reach + 1));
  for (int iy = y0; iy <= y1; ++iy) {
    const double y = iy + 0.5;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t k = 0; k < hull.size(); ++k) {
      const Vec2 &p = hull[k], &q = hull[(k + 1) % hull.size()];
      if ((p.y() <= y) == (q.y() <= y)) continue;
      const double x = p.x() + (y - p.y()) / (q.y() - p.y()) * (q.x() - p.x());
      low = std::min(low, x), high = std::max(high, x);
    }
    if (low <= high) changed += Span(layer, iy, low - kRim, high + kRim, by);
  }
  return changed;
}

}  // namespace floorproof
