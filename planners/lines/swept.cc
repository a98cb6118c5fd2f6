// SPDX-License-Identifier: Apache-2.0
// A tool that moves straight and does not turn sweeps the convex hull of where it begins and ends.
// For a disc that is a capsule. A footprint is held at the frame's yaw and taken as its convex
// hull.
#include "planners/lines/swept.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "env/geometry/interpolate.h"
#include "planners/search/index.h"

namespace floorproof {
namespace {

constexpr int kTile = 16;                     // cells
constexpr std::uint16_t kNoGround = 1 << 15;  // more than ever lies over a cell
constexpr double kRim = 1e-6;                 // cells: the rim counts, as in ComputeSweepArea

}  // namespace

// The cells under the tool while it moves straight from a to b, row by row.
class Swept::Strip {
 public:
  Strip(const Layer& layer, const Vec2& from, const Vec2& to) : width_(layer.count.width) {
    // One order for both ways, so that what was added one way can be taken back the other.
    const bool swap = to.x() < from.x() || (to.x() == from.x() && to.y() < from.y());
    a_ = swap ? to : from, b_ = swap ? from : to;
    first_row_ = std::max(0, static_cast<int>(std::min(a_.y(), b_.y()) - layer.reach - 1));
    last_row_ = std::min(layer.count.height - 1,
                         static_cast<int>(std::max(a_.y(), b_.y()) + layer.reach + 1));
    if (!layer.tool.empty()) {
      for (const Vec2& p : layer.tool) hull_.push_back(a_ + p), hull_.push_back(b_ + p);
      hull_ = ConvexHull(hull_);
      return;
    }
    // The strip between the ends has two long sides, offset by +-side; its short ones lie within
    // the discs. Where a row crosses a long side: x = a.x + side.x + (y - a.y - side.y) * slope.
    r_ = layer.reach + kRim;
    const Vec2 way = b_ - a_;
    const double length = way.norm();
    if (length > 0) side_ = Vec2(-way.y() / length * r_, way.x() / length * r_);
    slope_ = way.y() != 0 ? way.x() / way.y() : 0;
  }

  int first_row() const { return first_row_; }
  int last_row() const { return last_row_; }
  Cells At(int iy) const {
    if (iy < first_row_ || iy > last_row_) return {};
    return hull_.empty() ? Capsule(iy + 0.5) : Hull(iy + 0.5);
  }

 private:
  Cells Within(double low, double high) const {
    if (!(low <= high)) return {};
    const Cells cells{-RoundDown(-std::max(0.0, low - 0.5)),
                      std::min(width_ - 1, RoundDown(high - 0.5))};
    return cells.first <= cells.last ? cells : Cells{};
  }

  Cells Capsule(double y) const {
    const double da = y - a_.y(), db = y - b_.y();
    double low = std::numeric_limits<double>::infinity(), high = -low;
    if (const double h2 = r_ * r_ - da * da; h2 >= 0) {
      const double h = std::sqrt(h2);
      low = a_.x() - h, high = a_.x() + h;
    }
    if (const double h2 = r_ * r_ - db * db; h2 >= 0) {
      const double h = std::sqrt(h2);
      low = std::min(low, b_.x() - h), high = std::max(high, b_.x() + h);
    }
    if ((da <= side_.y()) != (db <= side_.y())) {
      const double x = a_.x() + side_.x() + (da - side_.y()) * slope_;
      low = std::min(low, x), high = std::max(high, x);
    }
    if ((da <= -side_.y()) != (db <= -side_.y())) {
      const double x = a_.x() - side_.x() + (da + side_.y()) * slope_;
      low = std::min(low, x), high = std::max(high, x);
    }
    return Within(low, high);
  }

  Cells Hull(double y) const {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t k = 0; k < hull_.size(); ++k) {
      const Vec2 &p = hull_[k], &q = hull_[(k + 1) % hull_.size()];
      if ((p.y() <= y) == (q.y() <= y)) continue;
      const double x = p.x() + (y - p.y()) / (q.y() - p.y()) * (q.x() - p.x());
      low = std::min(low, x), high = std::max(high, x);
    }
    return Within(low - kRim, high + kRim);
  }

  int width_, first_row_ = 0, last_row_ = -1;
  Vec2 a_, b_;
  double r_ = 0, slope_ = 0;
  Vec2 side_ = Vec2::Zero();
  Polygon hull_;  // of a footprint
};

Swept::Swept(const Floor& floor) : floor_(&floor) {
  const auto without = [](Grid<std::uint8_t> mask, const Grid<std::uint8_t>& other) {
    for (std::size_t i = 0; i < other.cells.size(); ++i) mask.cells[i] &= !other.cells[i];
    return mask;
  };
  layers_.push_back(MakeLayer(floor.narrow, without(floor.inner, floor.hidden)));
  if (floor.narrow < 1)
    layers_.push_back(MakeLayer(1, without(without(floor.ground, floor.inner), floor.hidden)));
  if (!floor.hidden.cells.empty())
    layers_.push_back(MakeLayer(floor.near_reach / floor.tool_reach, floor.hidden));
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
      layer.count(ix, iy) = mask(ix, iy) ? 0 : kNoGround;
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

int Swept::Span(Layer& layer, int iy, int x0, int x1, int by) {
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
  const Strip strip(layer, from, to);
  int changed = 0;
  for (int iy = strip.first_row(); iy <= strip.last_row(); ++iy)
    if (const Cells cells = strip.At(iy); cells.first <= cells.last)
      changed += Span(layer, iy, cells.first, cells.last, by);
  return changed;
}

void Swept::Exchange::Begin(std::span<const Vec2> old) {
  legs_ = old.size() - 1;
  for (std::size_t l = 0; l < swept_.layers_.size(); ++l) {
    const Layer& layer = swept_.layers_[l];
    Rows& rows = rows_[l];
    std::array<std::optional<Strip>, kMaxLegs> strips;
    rows.first = layer.count.height;
    rows.last = -1;
    for (std::size_t k = 0; k < legs_; ++k) {
      const Strip& strip = strips[k].emplace(layer, old[k], old[k + 1]);
      rows.first = std::min(rows.first, strip.first_row());
      rows.last = std::max(rows.last, strip.last_row());
    }
    rows.cells.assign(static_cast<std::size_t>(std::max(0, rows.last - rows.first + 1)), {});
    for (int iy = rows.first; iy <= rows.last; ++iy)
      for (std::size_t k = 0; k < legs_; ++k)
        rows.cells[static_cast<std::size_t>(iy - rows.first)][k] = strips[k]->At(iy);
  }
}

int Swept::Exchange::Won(std::span<const Vec2> fresh) const {
  int won = 0;
  for (std::size_t l = 0; l < swept_.layers_.size(); ++l) {
    const Layer& layer = swept_.layers_[l];
    const Rows& rows = rows_[l];
    std::array<std::optional<Strip>, kMaxLegs> strips;
    int first = rows.first, last = rows.last;
    for (std::size_t k = 0; k < legs_; ++k) {
      const Strip& strip = strips[k].emplace(layer, fresh[k], fresh[k + 1]);
      first = std::min(first, strip.first_row());
      last = std::max(last, strip.last_row());
    }
    for (int iy = first; iy <= last; ++iy) {
      LegCells before, after;
      if (iy >= rows.first && iy <= rows.last)
        before = rows.cells[static_cast<std::size_t>(iy - rows.first)];
      for (std::size_t k = 0; k < legs_; ++k) after[k] = strips[k]->At(iy);
      if (before != after)
        won += WonInRow(&layer.count.cells[layer.count.Index(0, iy)], before, after);
    }
  }
  return won;
}

namespace {

// Cells of a row from `from` to before `to` that lie under so many strips.
int Count(const std::uint16_t* count, int from, int to, int strips) {
  int n = 0;
  for (int ix = from; ix < to; ++ix) n += count[ix] == strips;
  return n;
}

}  // namespace

// The leg that alone has cells; -1: there are several, or none.
int Swept::Exchange::OnlyOne(const LegCells& legs) {
  int only = -1;
  for (std::size_t k = 0; k < kMaxLegs; ++k)
    if (legs[k].first <= legs[k].last) {
      if (only >= 0) return -1;
      only = static_cast<int>(k);
    }
  return only;
}

// Where the number of strips over a cell changes between none and some, the count tells whether
// others sweep it too.
int Swept::Exchange::WonInRow(const std::uint16_t* count, const LegCells& before,
                              const LegCells& after) {
  // Mostly one leg crosses the row: only what lies between its old sides and its new ones changes.
  const int a = OnlyOne(before), b = OnlyOne(after);
  if (a >= 0 && b >= 0) {
    const Cells &was = before[Z(a)], &is = after[Z(b)];
    if (was.first <= is.last && is.first <= was.last)
      return Count(count, is.first, was.first, 0) - Count(count, was.first, is.first, 1) +
             Count(count, was.last + 1, is.last + 1, 0) -
             Count(count, is.last + 1, was.last + 1, 1);
  }
  struct Border {
    int at, before, after;  // what begins (1) or ends (-1) there
  };
  std::array<Border, 4 * kMaxLegs> borders;
  std::size_t n = 0;
  const auto add = [&](Border border) {
    std::size_t k = n++;
    for (; k > 0 && borders[k - 1].at > border.at; --k) borders[k] = borders[k - 1];
    borders[k] = border;
  };
  for (const Cells& cells : before)
    if (cells.first <= cells.last) add({cells.first, 1, 0}), add({cells.last + 1, -1, 0});
  for (const Cells& cells : after)
    if (cells.first <= cells.last) add({cells.first, 0, 1}), add({cells.last + 1, 0, -1});

  int won = 0, over_before = 0, over_after = 0;
  for (std::size_t k = 0; k + 1 < n; ++k) {
    over_before += borders[k].before;
    over_after += borders[k].after;
    if ((over_before > 0) == (over_after > 0)) continue;
    const int alone = Count(count, borders[k].at, borders[k + 1].at, over_before);
    won += over_before > 0 ? -alone : alone;
  }
  return won;
}

}  // namespace floorproof
