// SPDX-License-Identifier: Apache-2.0
// Poses with the margin grow from the start's. Dijkstra's search goes out from them over all other
// poses, where steps cost the more the less room there is. Where it comes to poses with the margin,
// its way there is a narrow place's middle, and all that are connected to these are taken. So all
// parts of the floor are joined. What cannot be swept from them, in dead ends, is reached likewise,
// the farthest first.
//
// Assumed: a place is narrow only where less than the margin and a cell is free on either side, so
// that its middle is that of the free poses in a row or a column of cells.
// Not done: the widest of several ways to a part is not looked for, the cheapest is.
#include "planners/lines/kept_margin.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <queue>
#include <span>
#include <utility>

#include "env/geometry/distance.h"
#include "planners/lines/floor.h"

namespace floorproof {
namespace {

constexpr double kShallow = 20;  // how much more a step costs where no room is to spare
constexpr double kRunUp = 6;     // cells, over which a path comes to a narrow place's middle

// The sides first.
constexpr Cell kAround[] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}};

Grid<float> RoomOf(const Grid<std::uint8_t>& free) {
  Grid<std::uint8_t> blocked(free.width, free.height);
  for (std::size_t i = 0; i < free.cells.size(); ++i) blocked.cells[i] = !free.cells[i];
  return DistanceToSet(blocked, true);
}

// Joins poses with the margin by ways through poses without it.
class Joiner {
 public:
  // wide: poses with the margin, all of them free. diagonal: a robot passes between neighbours that
  // touch at a corner.
  Joiner(const Grid<std::uint8_t>& free, const Grid<std::uint8_t>& wide, double margin_cells,
         bool diagonal)
      : moves_(std::span(kAround).first(diagonal ? 8 : 4)),
        free_(free),
        wide_(wide),
        room_(RoomOf(free)),
        enough_(static_cast<float>(margin_cells + 1)),
        ends_at_(static_cast<std::ptrdiff_t>(std::ceil(margin_cells))),
        cost_(free.width, free.height, std::numeric_limits<float>::infinity()),
        from_(free.width, free.height, -1),
        poses_(free.width, free.height) {}

  // Takes this pose and, where it has the margin, all with it that are connected.
  void Take(Cell seed) {
    stack_.assign(1, seed);
    while (!stack_.empty()) {
      const Cell c = stack_.back();
      stack_.pop_back();
      if (poses_(c)) continue;
      poses_(c) = 1;
      bool is_rim = !wide_(c);
      for (std::size_t k = 0; k < moves_.size(); ++k) {
        const Cell n{c.ix + moves_[k].ix, c.iy + moves_[k].iy};
        if (!free_.Inside(n) || !free_(n)) continue;
        if (!wide_(n)) is_rim = true;
        if (wide_(c) && wide_(n) && !poses_(n)) stack_.push_back(n);
      }
      cost_(c) = 0;
      from_(c) = -1;
      if (is_rim) open_.push({0, static_cast<int>(free_.Index(c.ix, c.iy))});
    }
  }

  // Until every free pose has been reached.
  void JoinAll() {
    while (!open_.empty()) {
      const auto [cost, at] = open_.top();
      open_.pop();
      const Cell c = CellOf(at);
      if (cost > cost_(c)) continue;
      if (wide_(c) && !poses_(c)) {
        TakeWayTo(c);
        Take(c);
        continue;
      }
      for (const Cell& d : moves_)
        if (const Cell n{c.ix + d.ix, c.iy + d.iy}; free_.Inside(n) && free_(n))
          Reach(n,
                cost + StepCost(n) * std::hypot(static_cast<float>(d.ix), static_cast<float>(d.iy)),
                at);
    }
  }

  // Ways to what is not swept: of poses whose own cell is not, the farthest first.
  void TakeDeadEnds(const Grid<std::uint8_t>& swept, double tool_radius) {
    std::vector<std::pair<float, int>> left;
    for (int i = 0; i < static_cast<int>(free_.cells.size()); ++i) {
      const auto at = static_cast<std::size_t>(i);
      if (free_.cells[at] && !swept.cells[at] && from_.cells[at] >= 0)
        left.emplace_back(cost_.cells[at], i);
    }
    std::ranges::sort(left, std::greater{});
    Grid<std::uint8_t> reached(free_.width, free_.height);
    for (const auto& [cost, at] : left) {
      if (reached(CellOf(at)) || poses_(CellOf(at))) continue;
      for (const Cell& c : TakeWayTo(CellOf(at), true)) MarkAround(c, tool_radius, reached);
    }
  }

  const Grid<std::uint8_t>& poses() const { return poses_; }

 private:
  Cell CellOf(int at) const { return {at % free_.width, at / free_.width}; }
  float StepCost(Cell c) const {
    const float lacks = std::max(0.0f, 1 - room_(c) / enough_);
    return 1 + static_cast<float>(kShallow) * lacks * lacks;
  }
  void Reach(Cell c, float cost, int from) {
    if (cost >= cost_(c)) return;
    cost_(c) = cost;
    from_(c) = from;
    open_.push({cost, static_cast<int>(free_.Index(c.ix, c.iy))});
  }

  // Takes the way from the poses so far, and beside it those with as much room: two in the middle
  // of an even number, and what a slanting way cuts off at its corners.
  // `ends`: at a wall, from which as much is kept as elsewhere.
  std::vector<Cell> TakeWayTo(Cell c, bool ends = false) {
    constexpr float kAsMuch = 0.75f;  // cells less
    std::vector<Cell> way;
    for (; !poses_(c); c = CellOf(from_(c))) way.push_back(c);
    if (ends) way.erase(way.begin(), way.begin() + std::min(std::ssize(way) - 1, ends_at_));
    for (const Cell& w : way) {
      poses_(w) = 1;
      if (ends && w == way.front()) continue;  // nothing beyond its end
      for (const Cell& d : kAround) {
        const Cell n{w.ix + d.ix, w.iy + d.iy};
        if (free_.Inside(n) && free_(n) && room_(n) > room_(w) - kAsMuch) poses_(n) = 1;
      }
    }
    return way;
  }

  void MarkAround(Cell c, double radius, Grid<std::uint8_t>& out) const {
    const int reach = static_cast<int>(radius);
    for (int iy = std::max(0, c.iy - reach); iy <= std::min(out.height - 1, c.iy + reach); ++iy)
      for (int ix = std::max(0, c.ix - reach); ix <= std::min(out.width - 1, c.ix + reach); ++ix)
        if (std::hypot(ix - c.ix, iy - c.iy) <= radius) out(ix, iy) = 1;
  }

  const std::span<const Cell> moves_;
  const Grid<std::uint8_t>& free_;
  const Grid<std::uint8_t>& wide_;
  Grid<float> room_;        // cells to the nearest pose that is not free
  float enough_;            // of it, that costs nothing more
  std::ptrdiff_t ends_at_;  // before a dead end's last pose, cells
  Grid<float> cost_;
  Grid<std::int32_t> from_;
  Grid<std::uint8_t> poses_;
  std::vector<Cell> stack_;
  using Entry = std::pair<float, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open_;
};

// The free pose nearest to the start, within a cell.
std::optional<Cell> StartCell(const Grid<std::uint8_t>& free, Cell start) {
  if (free.Inside(start) && free(start)) return start;
  for (const Cell& d : kAround)
    if (const Cell n{start.ix + d.ix, start.iy + d.iy}; free.Inside(n) && free(n)) return n;
  return std::nullopt;
}

}  // namespace

KeptMargin::KeptMargin(const FloorRoom& room, const HeldShapes& held, double margin_m,
                       const SweepArea& bare, const Vec2& start_W)
    : free_(bare.reachable),
      narrow_(free_.width, free_.height),
      reach_(static_cast<int>(std::ceil(margin_m / bare.frame.cell_m)) + 1) {
  const double cell_m = bare.frame.cell_m;
  Grid<std::uint8_t> wide = std::move(room.Free(Grown(held.clear, margin_m), held.yaws)[0]);
  for (std::size_t i = 0; i < wide.cells.size(); ++i) wide.cells[i] &= free_.cells[i];
  Joiner joiner(free_, wide, margin_m / cell_m, held.clear.kind == Shape2::Kind::kCircle);
  if (const auto start = StartCell(free_, bare.frame.ToCell(start_W))) joiner.Take(*start);
  joiner.JoinAll();
  area_ = room.SweptFrom({joiner.poses()}, held.tool, held.yaws);
  const double tool_radius = held.tool.kind == Shape2::Kind::kCircle
                                 ? held.tool.radius_m
                                 : -SignedDistance(held.tool.footprint_B, Vec2::Zero());
  joiner.TakeDeadEnds(area_.sweepable, std::max(0.0, tool_radius) / cell_m);
  area_ = room.SweptFrom({joiner.poses()}, held.tool, held.yaws);
  for (std::size_t i = 0; i < wide.cells.size(); ++i)
    narrow_.cells[i] = area_.reachable.cells[i] && !wide.cells[i];
}

bool KeptMargin::IsNarrow(const Vec2& p_G) const {
  const Cell c = Floor::CellAt(p_G);
  return narrow_.Inside(c) && narrow_(c);
}

// In the middle of the free poses across the place: along the grid's axis on which fewer are free;
// the point itself where so many are that the place is not narrow.
Vec2 KeptMargin::Middle(const Vec2& p_G) const {
  const Cell at = Floor::CellAt(p_G);
  if (!free_.Inside(at) || !free_(at)) return p_G;
  struct Run {
    int low = 0, high = 0;  // cells to either side that are free
    int length() const { return high - low + 1; }
  };
  const auto run_along = [&](int dx, int dy) {
    const auto is_free = [&](int k) {
      const Cell c{at.ix + k * dx, at.iy + k * dy};
      return free_.Inside(c) && free_(c);
    };
    Run run;
    while (run.low >= -reach_ && is_free(run.low - 1)) --run.low;
    while (run.high <= reach_ && is_free(run.high + 1)) ++run.high;
    return run;
  };
  const Run x = run_along(1, 0), y = run_along(0, 1);
  const bool across_x = x.length() < y.length();
  const Run& across = across_x ? x : y;
  if (across.low < -reach_ || across.high > reach_) return p_G;
  const double middle = (across_x ? at.ix : at.iy) + (across.low + across.high + 1) / 2.0;
  return across_x ? Vec2(middle, p_G.y()) : Vec2(p_G.x(), middle);
}

std::vector<Vec2> KeptMargin::Centred(const std::vector<Vec2>& path_W) const {
  const GridFrame& frame = area_.frame;
  Polyline path_G;
  for (const Vec2& p_W : path_W) path_G.push_back(frame.ToGrid(p_W) / frame.cell_m);
  Polyline corners_G = path_G;
  for (std::size_t i = 1; i < path_G.size(); ++i)  // the first is the start
    if (IsNarrow(path_G[i])) corners_G[i] = Middle(path_G[i]);
  Polyline out_G;
  for (std::size_t i = 0; i + 1 < path_G.size(); ++i) {
    out_G.push_back(corners_G[i]);
    const Vec2 &a = path_G[i], way = path_G[i + 1] - a;
    const double length = way.norm();
    const auto point = [&](double s) -> Vec2 { return a + s / length * way; };
    double narrow_s = IsNarrow(a) ? 0 : -kRunUp;  // the last place that is narrow
    for (double s = 1; s < length; s += 1) {
      if (!IsNarrow(point(s))) continue;
      if (s - narrow_s > 2 * kRunUp) {
        if (narrow_s >= 0) out_G.push_back(point(narrow_s + kRunUp));
        out_G.push_back(point(s - kRunUp));
      }
      out_G.push_back(Middle(point(s)));
      narrow_s = s;
    }
    if (narrow_s >= 0 && length - narrow_s > kRunUp && !IsNarrow(path_G[i + 1]))
      out_G.push_back(point(narrow_s + kRunUp));
  }
  if (!path_G.empty()) out_G.push_back(corners_G.back());
  std::vector<Vec2> out_W;
  for (const Vec2& p_G : MergeStraight(out_G)) out_W.push_back(frame.X_WG * (p_G * frame.cell_m));
  return out_W;
}

int KeptMargin::PlacesOn(const std::vector<Vec2>& path_W) const {
  const GridFrame& frame = area_.frame;
  int places = 0;
  bool was_narrow = false;
  for (std::size_t i = 0; i + 1 < path_W.size(); ++i) {
    const Vec2 a = frame.ToGrid(path_W[i]) / frame.cell_m;
    const Vec2 way = frame.ToGrid(path_W[i + 1]) / frame.cell_m - a;
    const double length = way.norm();
    for (double s = 0; s < length; s += 1) {
      const bool narrow = IsNarrow(a + s / length * way);
      places += narrow && !was_narrow;
      was_narrow = narrow;
    }
  }
  return places;
}

}  // namespace floorproof
