// SPDX-License-Identifier: Apache-2.0
// Routes: A* over the floor's cells and their 8 neighbours. Then the string is pulled taut: corners
// are cut wherever one sees past them, in a few rounds.
//
// Distances for ordering a tour are asked for by the ten thousand. Nearby they are found by A* over
// coarse cells of 0.1 m. From afar they come from a table between blocks of about 0.8 m (all pairs,
// by Dijkstra's search). The nearest places are found by Dijkstra's search over coarse cells.
// Not the shortest of all any-angle paths: the one in the same corridor as the grid's.
#include "planners/lines/shortest_paths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "planners/search/neighbours.h"

namespace floorproof {
namespace {

constexpr std::array<Cell, 8> kNeighbours = {Cell{1, 0}, Cell{0, 1},  Cell{-1, 0},  Cell{0, -1},
                                             Cell{1, 1}, Cell{-1, 1}, Cell{-1, -1}, Cell{1, -1}};
constexpr float kSqrt2 = 1.41421356f;
constexpr std::size_t kMaxBlocks = 1200;
constexpr double kOffPose = 3;  // cells that a point may lie off the poses
constexpr float kUnreachable = std::numeric_limits<float>::infinity();

bool IsDiagonal(Cell step) { return step.ix != 0 && step.iy != 0; }

// The length of the shortest path over free cells, with diagonal steps.
float Octile(Cell a, Cell b) {
  const auto x = static_cast<float>(std::abs(a.ix - b.ix)),
             y = static_cast<float>(std::abs(a.iy - b.iy));
  return std::max(x, y) + (kSqrt2 - 1) * std::min(x, y);
}

int CoarseStep(const Floor& floor) {
  return std::max(1, static_cast<int>(std::lround(0.1 / floor.frame.cell_m)));
}

// 1 where a coarse cell holds a pose.
Grid<std::uint8_t> CoarsePoses(const Floor& floor, int step) {
  Grid<std::uint8_t> coarse((floor.frame.width + step - 1) / step,
                            (floor.frame.height + step - 1) / step);
  for (int iy = 0; iy < floor.frame.height; ++iy)
    for (int ix = 0; ix < floor.frame.width; ++ix)
      if (floor.pose(ix, iy)) coarse(ix / step, iy / step) = 1;
  return coarse;
}

}  // namespace

ShortestPaths::ShortestPaths(const Floor& floor)
    : floor_(floor),
      fine_search_(floor.pose.cells.size()),
      step_(CoarseStep(floor)),
      coarse_(CoarsePoses(floor, step_)),
      coarse_search_(coarse_.cells.size()),
      place_search_(coarse_.cells.size()) {
  NameBlocks();
  BuildBlocks();
}

// Cuts the floor into the connected pieces of square blocks, which grow until there are few enough
// pieces for the table.
void ShortestPaths::NameBlocks() {
  const auto cells = static_cast<std::size_t>(
      std::count(coarse_.cells.begin(), coarse_.cells.end(), std::uint8_t{1}));
  int side = 8;  // coarse cells a block
  for (;; side = side * 3 / 2) {
    if (cells > kMaxBlocks * Z(side) * Z(side)) continue;  // too many blocks, whatever their shape
    block_of_ = Grid<std::int32_t>(coarse_.width, coarse_.height, -1);
    block_at_.clear();
    std::vector<Cell> stack;
    for (int iy = 0; iy < coarse_.height; ++iy)
      for (int ix = 0; ix < coarse_.width; ++ix) {
        if (!coarse_(ix, iy) || block_of_(ix, iy) >= 0) continue;
        const auto id = static_cast<std::int32_t>(block_at_.size());
        Vec2 sum = Vec2::Zero();
        int count = 0;
        stack.push_back({ix, iy});
        block_of_(ix, iy) = id;
        while (!stack.empty()) {
          const Cell c = stack.back();
          stack.pop_back();
          sum += Floor::CentreOf(c);
          ++count;
          for (const Cell d : kNeighbours) {
            const Cell n = c + d;
            if (!coarse_.Inside(n) || !coarse_(n) || block_of_(n) >= 0) continue;
            if (n.ix / side != ix / side || n.iy / side != iy / side) continue;
            block_of_(n) = id;
            stack.push_back(n);
          }
        }
        block_at_.push_back(sum / count * step_);
      }
    if (block_at_.size() <= kMaxBlocks) break;
  }
  block_ = side * step_;
}

// The table of distances: paths from middle to middle of neighbouring blocks.
void ShortestPaths::BuildBlocks() {
  const std::size_t n = block_at_.size();
  std::vector<std::vector<std::pair<int, float>>> graph(n);
  for (int iy = 0; iy < coarse_.height; ++iy)
    for (int ix = 0; ix < coarse_.width; ++ix) {
      if (!coarse_(ix, iy)) continue;
      const int a = block_of_(ix, iy);
      for (const Cell d : kNeighbours) {
        const Cell c = Cell{ix, iy} + d;
        if (!coarse_.Inside(c) || !coarse_(c) || block_of_(c) == a) continue;
        const int b = block_of_(c);
        auto& edges = graph[Z(a)];
        if (std::none_of(edges.begin(), edges.end(), [b](const auto& e) { return e.first == b; }))
          edges.push_back({b, static_cast<float>((block_at_[Z(a)] - block_at_[Z(b)]).norm())});
      }
    }
  block_distance_.assign(n * n, kUnreachable);
  BestFirstSearch<float> search(n);
  for (std::size_t from = 0; from < n; ++from) {
    search.Begin();
    search.Reach(static_cast<int>(from), 0);
    search.Run(
        [&](const auto& at) {
          block_distance_[from * n + Z(at.node)] = at.cost;
          return false;
        },
        [&](const auto& at, const auto& reach) {
          for (const auto& [b, length] : graph[Z(at.node)]) reach(b, at.cost + length);
        });
  }
}

Cell ShortestPaths::NearestPose(const Vec2& p, double reach) const {
  const Cell c = Floor::CellAt(p);
  if (floor_.pose.Inside(c) && floor_.pose(c)) return c;
  const int r = static_cast<int>(std::ceil(reach));
  Cell best{-1, -1};
  double best_d = reach * reach;
  for (int iy = std::max(0, c.iy - r); iy <= std::min(floor_.frame.height - 1, c.iy + r); ++iy)
    for (int ix = std::max(0, c.ix - r); ix <= std::min(floor_.frame.width - 1, c.ix + r); ++ix)
      if (floor_.pose(ix, iy)) {
        const double d = (Floor::CentreOf({ix, iy}) - p).squaredNorm();
        if (d < best_d) best_d = d, best = {ix, iy};
      }
  return best;
}

// From pose to pose, both included; empty: there is no path.
std::vector<Cell> ShortestPaths::Search(Cell from, Cell to) {
  const Grid<std::uint8_t>& pose = floor_.pose;
  const int goal = NumberOf(pose, to);
  fine_search_.Begin();
  fine_search_.Reach(NumberOf(pose, from), 0);
  const int end = fine_search_.Run(
      [&](int node) { return Octile(CellAt(pose, Z(node)), to); },
      [&](const auto& at) { return at.node == goal; },
      [&](const auto& at, const auto& reach) {
        const Cell c = CellAt(pose, Z(at.node));
        for (const Cell d : kNeighbours) {
          const Cell n = c + d;
          if (!pose(n)) continue;
          // A footprint would scrape what blocks the cells beside; a circle clears it by less than
          // `tolerance`.
          const bool diagonal = IsDiagonal(d);
          if (diagonal && floor_.clears_footprint && !(pose(n.ix, c.iy) && pose(c.ix, n.iy)))
            continue;
          reach(NumberOf(pose, n), at.cost + (diagonal ? kSqrt2 : 1.0f));
        }
      });
  std::vector<Cell> cells;
  for (const int node : fine_search_.PathTo(end)) cells.push_back(CellAt(pose, Z(node)));
  return cells;
}

Polyline ShortestPaths::Route(const Vec2& a, const Vec2& b) {
  if (floor_.Sees(a, b)) return {a, b};
  const Cell from = NearestPose(a, kOffPose), to = NearestPose(b, kOffPose);
  if (from.ix < 0 || to.ix < 0) return {};
  const std::vector<Cell> cells = Search(from, to);
  if (cells.empty()) return {};
  Polyline line = {a};
  for (const Cell c : cells) line.push_back(Floor::CentreOf(c));
  line.push_back(b);
  // From each corner to the farthest point in sight, found by doubling and halving.
  Polyline taut = {a};
  for (std::size_t i = 0; i + 1 < line.size();) {
    std::size_t good = i + 1, step = 1;
    while (good + step < line.size() && floor_.Sees(line[i], line[good + step])) {
      good += step;
      step *= 2;
    }
    for (; step > 0; step /= 2)
      if (good + step < line.size() && floor_.Sees(line[i], line[good + step])) good += step;
    taut.push_back(line[good]);
    i = good;
  }
  // Corners move towards the straight line between their neighbours as far as the floor allows.
  for (int round = 0; round < 3; ++round)
    for (std::size_t i = 1; i + 1 < taut.size();) {
      const Vec2 p = taut[i - 1], q = taut[i + 1];
      if (floor_.Sees(p, q)) {
        taut.erase(taut.begin() + static_cast<std::ptrdiff_t>(i));
        continue;
      }
      const Vec2 target = p + NearestFraction(p, q, taut[i]) * (q - p);
      for (const double pull : {0.6, 0.3, 0.1}) {
        const Vec2 moved = taut[i] + pull * (target - taut[i]);
        if (floor_.Sees(p, moved) && floor_.Sees(moved, q)) {
          taut[i] = moved;
          break;
        }
      }
      ++i;
    }
  return taut;
}

double ShortestPaths::CoarseDistance(int from, int to) {
  const Cell goal = CellAt(coarse_, Z(to));
  coarse_search_.Begin();
  coarse_search_.Reach(from, 0);
  const int end = coarse_search_.Run(
      [&](int node) { return Octile(CellAt(coarse_, Z(node)), goal); },
      [&](const auto& at) { return at.node == to; },
      [&](const auto& at, const auto& reach) {
        const Cell c = CellAt(coarse_, Z(at.node));
        for (const Cell d : kNeighbours) {
          const Cell n = c + d;
          if (coarse_.Inside(n) && coarse_(n))
            reach(NumberOf(coarse_, n), at.cost + (IsDiagonal(d) ? kSqrt2 : 1.0f));
        }
      });
  coarse_budget_ -= coarse_search_.pops();
  if (end < 0) return std::numeric_limits<double>::infinity();
  return static_cast<double>(coarse_search_.CostOf(end)) * step_;
}

int ShortestPaths::CoarseAt(const Vec2& p) const {
  const Cell near = NearestPose(p, kOffPose);
  return static_cast<int>(
      coarse_.Index(std::max(0, near.ix) / step_, std::max(0, near.iy) / step_));
}

void ShortestPaths::IndexPlaces(const std::vector<Vec2>& places) {
  places_ = places;
  place_cell_.clear();
  for (const Vec2& p : places) place_cell_.push_back(CoarseAt(p));
  on_coarse_.Fill(coarse_.cells.size(), place_cell_);

  // About two places a square, were they spread over the whole floor.
  const double w = floor_.frame.width, h = floor_.frame.height;
  square_ = std::max(1.0, std::sqrt(2 * w * h / std::max(1.0, static_cast<double>(places.size()))));
  squares_ = Grid<char>(static_cast<int>(w / square_) + 1, static_cast<int>(h / square_) + 1);
  std::vector<int> square_of;
  for (const Vec2& p : places) square_of.push_back(NumberOf(squares_, SquareAt(p)));
  on_squares_.Fill(squares_.cells.size(), square_of);
}

Cell ShortestPaths::SquareAt(const Vec2& p) const {
  return {std::clamp(static_cast<int>(p.x() / square_), 0, squares_.width - 1),
          std::clamp(static_cast<int>(p.y() / square_), 0, squares_.height - 1)};
}

// In plain sight, by the straight line. `hidden`: whether a place that is none of them is as near.
std::vector<ShortestPaths::Near> ShortestPaths::NearestInSight(int place, std::size_t count,
                                                               bool& hidden) const {
  constexpr std::size_t kMost = 8;  // times as many places are looked at
  const Vec2& a = places_[Z(place)];
  const Cell middle = SquareAt(a);
  std::vector<Near> near, found;
  std::size_t looked = 0;
  hidden = false;
  for (int ring = 0; ring <= std::max(squares_.width, squares_.height); ++ring) {
    for (int iy = middle.iy - ring; iy <= middle.iy + ring; ++iy)
      for (int ix = middle.ix - ring; ix <= middle.ix + ring; ++ix) {
        const bool on_ring = std::abs(iy - middle.iy) == ring || std::abs(ix - middle.ix) == ring;
        if (!on_ring || !squares_.Inside(ix, iy)) continue;
        for (const int other : on_squares_.Of(NumberOf(squares_, {ix, iy})))
          if (other != place) near.push_back({(places_[Z(other)] - a).norm(), other});
      }
    std::sort(near.begin(), near.end(), [](const Near& p, const Near& q) {
      return p.distance != q.distance ? p.distance < q.distance : p.place < q.place;
    });
    // Nothing that is nearer than this lies beyond the ring.
    const double whole = ring * square_;
    for (; looked < near.size() && near[looked].distance < whole; ++looked) {
      if (found.size() == count || looked == kMost * count) return found;
      if (floor_.Sees(a, places_[Z(near[looked].place)])) {
        found.push_back(near[looked]);
      } else {
        hidden = true;
      }
    }
  }
  return found;
}

// The straight line is the shortest way to what is in plain sight, and no way is shorter. So the
// nearest places are known once so many are seen, unless one as near is hidden. Then ways are
// looked for, by Dijkstra's search: to all places at the distance of the last one, or, where many
// are seen anyway, not farther than is soon done.
std::vector<ShortestPaths::Near> ShortestPaths::NearestPlaces(int place, std::size_t count) {
  constexpr std::int64_t kSoon = 2000;  // coarse cells
  bool hidden = false;
  const std::vector<Near> seen = NearestInSight(place, count, hidden);
  const bool many = seen.size() == count;
  if (many && !hidden) return seen;
  std::vector<Near> found;
  int cost = 0;
  place_search_.Begin();
  place_search_.Reach(place_cell_[Z(place)], 0);
  place_search_.Run(
      [&](const auto& at) {
        if (at.cost > cost && found.size() >= count) return true;
        if (many && place_search_.pops() > kSoon) return true;
        cost = at.cost;
        for (const int other : on_coarse_.Of(at.node)) {
          if (other == place) continue;
          const Vec2 &a = places_[Z(place)], &b = places_[Z(other)];
          const double straight = (b - a).norm();
          const double way = static_cast<double>(cost) / kStraight * step_;
          found.push_back({floor_.Sees(a, b) ? straight : std::max(straight, way), other});
        }
        return false;
      },
      [&](const auto& at, const auto& reach) {
        const Cell c = CellAt(coarse_, Z(at.node));
        for (const Cell d : kNeighbours) {
          const Cell n = c + d;
          if (coarse_.Inside(n) && coarse_(n))
            reach(NumberOf(coarse_, n), at.cost + (IsDiagonal(d) ? kDiagonal : kStraight));
        }
      });
  const std::size_t ways = found.size();
  for (const Near& one : seen) {
    if (found.size() >= count) break;
    const auto end = found.begin() + static_cast<std::ptrdiff_t>(ways);
    if (std::none_of(found.begin(), end, [&](const Near& f) { return f.place == one.place; }))
      found.push_back(one);
  }
  return found;
}

double ShortestPaths::Distance(const Vec2& a, const Vec2& b) {
  const double straight = (b - a).norm();
  if (straight < 2.0 * block_ && floor_.Sees(a, b)) return straight;
  const int ca = CoarseAt(a), cb = CoarseAt(b);
  const int block_a = block_of_.cells[Z(ca)];
  const int block_b = block_of_.cells[Z(cb)];
  if (block_a < 0 || block_b < 0) return std::numeric_limits<double>::infinity();
  const double table =
      static_cast<double>(block_distance_[Z(block_a) * block_at_.size() + Z(block_b)]);
  if (table > 3.0 * block_ || coarse_budget_ <= 0) return std::max(straight, table);
  return std::max(straight, CoarseDistance(ca, cb));
}

Polyline JoinByRoutes(ShortestPaths& paths, const std::vector<Polyline>& lines) {
  Polyline path;
  for (const Polyline& line : lines) {
    if (line.empty()) continue;
    if (!path.empty()) {
      const Polyline route = paths.Route(path.back(), line.front());
      if (route.empty()) continue;  // cut off: not a place to go to
      path.insert(path.end(), route.begin(), route.end());
    }
    path.insert(path.end(), line.begin(), line.end());
  }
  return path;
}

}  // namespace floorproof
