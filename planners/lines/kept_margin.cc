// SPDX-License-Identifier: Apache-2.0
// The search starts with the poses that keep the margin and are connected to the start. From them,
// Dijkstra's algorithm searches the other free poses; a step costs more where there is less room.
// When it reaches further poses with the margin, its path there follows the middle of a narrow
// place, and all poses connected to them are added. Paths into dead ends that are still unswept are
// added in the same manner, the farthest first.
//
// Assumption: a place is narrow only if less than the margin plus one cell is free on either side,
// so its middle is the middle of the free poses in a row or a column of cells. Limitation: of
// several paths to an area, the cheapest is chosen, not the widest.
#include "planners/lines/kept_margin.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <queue>
#include <span>
#include <utility>

#include "env/core/clear_cell.h"
#include "env/geometry/distance.h"
#include "planners/lines/floor.h"

namespace floorproof {
namespace {

constexpr double kShallow = 20;    // how much more a step costs where no room is to spare
constexpr std::size_t kRunUp = 6;  // cells, over which a path comes to a narrow place's middle

// The sides first.
constexpr Cell kAround[] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}};

Grid<float> RoomOf(const Grid<std::uint8_t>& free) {
  Grid<std::uint8_t> blocked(free.width, free.height);
  for (std::size_t i = 0; i < free.cells.size(); ++i) blocked.cells[i] = !free.cells[i];
  return DistanceToSet(blocked, true);
}

// Joins poses with the margin by paths through poses without it.
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
        if (from_(c) >= 0) TakeWayTo(CellOf(from_(c)));
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

  // Adds a path to this free pose.
  void TakePlace(Cell c) {
    if (!poses_(c) && from_(c) >= 0) TakeWayTo(c);
  }

  // Adds paths to poses whose own cell is not swept, the farthest first.
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

  // Adds the path from the poses so far, and neighbours with as much room: both middle cells if the
  // free width is even, and the cells at the corners of a diagonal path. ends: the path ends at a
  // wall, and the margin is kept from it.
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
        if (free_.Inside(n) && free_(n) && !wide_(n) && room_(n) > room_(w) - kAsMuch)
          poses_(n) = 1;
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

std::optional<Cell> FreeAt(const Grid<std::uint8_t>& free, const Vec2& p_G) {
  return ClearCellAt(free, Floor::CellAt(p_G), p_G);
}

// A tool's half width: it sweeps a pose's surroundings to this distance, wherever it is mounted.
double HalfWidth(const Shape2& tool) {
  if (tool.kind == Shape2::Kind::kCircle) return tool.radius_m;
  double low = 0, high = 0;
  for (const Vec2& p : tool.footprint_B) low = std::min(low, p.y()), high = std::max(high, p.y());
  return (high - low) / 2;
}

// The chain with fewer points, none farther off than this.
Polyline Simplified(const Polyline& line, double tolerance) {
  std::vector<cv::Point2f> points, out;
  for (const Vec2& p : line)
    points.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()));
  cv::approxPolyDP(points, out, tolerance, false);
  Polyline simplified;
  for (const cv::Point2f& p : out)
    simplified.emplace_back(static_cast<double>(p.x), static_cast<double>(p.y));
  return simplified;
}

}  // namespace

KeptMargin::KeptMargin(const FloorRoom& room, const HeldShapes& held, double margin_m,
                       const SweepArea& bare, const Vec2& start_W,
                       const std::vector<Vec2>& places_W)
    : frame_(bare.frame),
      free_(bare.reachable),
      narrow_(free_.width, free_.height),
      reach_(static_cast<int>(std::ceil(margin_m / bare.frame.cell_m)) + 1) {
  const double cell_m = frame_.cell_m;
  Grid<std::uint8_t> wide = std::move(room.Free(Grown(held.clear, margin_m), held.yaws)[0]);
  for (std::size_t i = 0; i < wide.cells.size(); ++i) wide.cells[i] &= free_.cells[i];
  Joiner joiner(free_, wide, margin_m / cell_m, held.clear.kind == Shape2::Kind::kCircle);
  if (const auto start = FreeAt(free_, ToCells(start_W))) joiner.Take(*start);
  joiner.JoinAll();
  for (const Vec2& p_W : places_W)
    if (const auto place = FreeAt(free_, ToCells(p_W))) joiner.TakePlace(*place);
  joiner.TakeDeadEnds(room.SweptFrom({joiner.poses()}, held.tool, held.yaws).sweepable,
                      HalfWidth(held.tool) / cell_m);
  area_ = room.SweptFrom({joiner.poses()}, held.tool, held.yaws);
  for (std::size_t i = 0; i < wide.cells.size(); ++i)
    narrow_.cells[i] = area_.reachable.cells[i] && !wide.cells[i];
}

bool KeptMargin::IsNarrow(const Vec2& p_G) const {
  const Cell c = Floor::CellAt(p_G);
  return narrow_.Inside(c) && narrow_(c);
}

// In the middle of the free poses across the place: along the grid's axis on which fewer are free.
// None where so many are that the place is not narrow.
std::optional<Vec2> KeptMargin::Middle(const Vec2& p_G) const {
  Cell at = Floor::CellAt(p_G);
  if (!IsNarrow(p_G)) {
    // A straight line cuts off corners of a slanting passage's cells.
    const auto pose = FreeAt(area_.reachable, p_G);
    if (!pose || *pose == at || !narrow_(*pose)) return std::nullopt;
    at = *pose;
  }
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
  if (across.low < -reach_ || across.high > reach_) return std::nullopt;
  const double middle = (across_x ? at.ix : at.iy) + (across.low + across.high + 1) / 2.0;
  return across_x ? Vec2(middle, p_G.y()) : Vec2(p_G.x(), middle);
}

// Whether each point between is as near to a free pose's centre as points of that cell are.
bool KeptMargin::IsFree(const Vec2& a, const Vec2& b) const {
  constexpr double kStep = 0.25;
  const double half_diagonal = std::sqrt(0.5), length = (b - a).norm();
  for (double s = 0; s <= length; s += kStep) {
    const Vec2 p = length > 0 ? Vec2(a + s / length * (b - a)) : a;
    const auto pose = FreeAt(free_, p);
    if (!pose || (Floor::CentreOf(*pose) - p).norm() > half_diagonal) return false;
  }
  return true;
}

// Samples of a path, each a cell from the next: its corners, and points between them.
std::vector<KeptMargin::Sample> KeptMargin::Sampled(const Polyline& path_G) const {
  std::vector<Sample> samples;
  const auto add = [&](const Vec2& p_G, bool is_corner) {
    samples.push_back({p_G, Middle(p_G), is_corner});
  };
  for (std::size_t i = 0; i < path_G.size(); ++i) {
    add(path_G[i], true);
    const Vec2 way = i + 1 < path_G.size() ? Vec2(path_G[i + 1] - path_G[i]) : Vec2(0, 0);
    const double length = way.norm();
    for (double s = 1; s < length; s += 1) add(path_G[i] + s / length * way, false);
  }
  return samples;
}

// The middle of a narrow stretch, in few points. The middles of rows or columns are off by half a
// cell at most, and in a slanting passage a staircase: so means are taken. If the resulting
// line does not keep to free poses, the corners stay as they are.
Polyline KeptMargin::MiddleOf(std::span<const Sample> stretch) const {
  constexpr int kMeanOf = 6;  // samples to either side
  constexpr double kOff = 0.15;
  const auto n = static_cast<int>(stretch.size());
  Polyline middle;
  for (int i = 0; i < n; ++i) {
    const int reach = std::min({kMeanOf, i, n - 1 - i});
    Vec2 sum = Vec2::Zero();
    for (int k = i - reach; k <= i + reach; ++k)
      sum += *stretch[static_cast<std::size_t>(k)].middle;
    middle.push_back(sum / (2 * reach + 1));
  }
  middle = Simplified(middle, kOff);
  bool is_free = true;
  for (std::size_t i = 1; is_free && i < middle.size(); ++i)
    is_free = IsFree(middle[i - 1], middle[i]);
  if (is_free) return middle;
  Polyline corners;
  for (const Sample& sample : stretch)
    if (sample.is_corner) corners.push_back(sample.p);
  return corners;
}

std::vector<Vec2> KeptMargin::Centred(const std::vector<Vec2>& path_W, bool keep_end) const {
  Polyline path_G;
  for (const Vec2& p_W : path_W) path_G.push_back(ToCells(p_W));
  std::vector<Sample> samples = Sampled(path_G);
  if (samples.empty()) return {};
  samples.front().middle.reset();  // the start stays
  if (keep_end) samples.back().middle.reset();
  const std::size_t n = samples.size();
  // Whether a path may come to the middle, or leave it, on a straight line over these samples.
  const auto is_plain = [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      if (samples[k].middle || samples[k].is_corner) return false;
    return true;
  };
  Polyline out_G;
  std::size_t done = 0;  // samples before this one are in `out_G`
  for (std::size_t k = 0; k < n;) {
    if (!samples[k].middle) {
      if (samples[k].is_corner) out_G.push_back(samples[k].p), done = k + 1;
      ++k;
      continue;
    }
    // Up to where the path turns back.
    constexpr double kBack = 2;  // cells
    const std::size_t first = k;
    std::size_t farthest = k;
    double most = 0;
    for (; k < n && samples[k].middle; ++k) {
      const double away = (samples[k].p - samples[first].p).norm();
      if (away < most - kBack) break;
      if (away >= most) most = away, farthest = k;
    }
    if (k < n && samples[k].middle) k = farthest + 1;
    if (first >= done + kRunUp && is_plain(first - kRunUp, first))
      out_G.push_back(samples[first - kRunUp].p);
    const Polyline middle = MiddleOf(std::span(samples).subspan(first, k - first));
    out_G.insert(out_G.end(), middle.begin(), middle.end());
    done = k;
    if (k + kRunUp < n && is_plain(k, k + kRunUp)) {
      out_G.push_back(samples[k + kRunUp - 1].p);
      done = k + kRunUp;
    }
  }
  std::vector<Vec2> out_W;
  for (const Vec2& p_G : MergeStraight(out_G)) out_W.push_back(frame_.X_WG * (p_G * frame_.cell_m));
  return out_W;
}

int KeptMargin::PlacesOn(const std::vector<Vec2>& path_W) const {
  int places = 0;
  bool was_narrow = false;
  for (std::size_t i = 0; i + 1 < path_W.size(); ++i) {
    const Vec2 a = ToCells(path_W[i]), way = ToCells(path_W[i + 1]) - a;
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
