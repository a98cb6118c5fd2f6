// SPDX-License-Identifier: Apache-2.0
// Routes: A* over 8 neighbours, then the string is pulled taut: corners are cut wherever the floor
// lets one see past them, at most a few rounds. Distances for ordering a tour are asked for by the
// ten thousand, so those from afar come from a table between blocks of about 0.8 m (all pairs by
// Dijkstra). Not the shortest of all any-angle ways: the one in the same corridor as the grid's.
#include "planners/lines/ways.h"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>

namespace floorproof {
namespace {

constexpr std::array<Cell, 8> kNeighbours = {Cell{1, 0}, Cell{0, 1},  Cell{-1, 0},  Cell{0, -1},
                                             Cell{1, 1}, Cell{-1, 1}, Cell{-1, -1}, Cell{1, -1}};
constexpr float kDiagonal = 1.41421356f;
constexpr std::size_t kMaxBlocks = 1200;
constexpr double kOffPose = 3;  // cells that a point may lie off the poses

float Octile(int dx, int dy) {
  const auto x = static_cast<float>(std::abs(dx)), y = static_cast<float>(std::abs(dy));
  return std::max(x, y) + (kDiagonal - 1) * std::min(x, y);
}

}  // namespace

Ways::Ways(const Floor& floor) : floor_(floor), nodes_(floor.pose.cells.size()) {
  step_ = std::max(1, static_cast<int>(std::lround(0.1 / floor.frame.cell_m)));
  coarse_ = Grid<std::uint8_t>((floor.frame.width + step_ - 1) / step_,
                               (floor.frame.height + step_ - 1) / step_);
  for (int iy = 0; iy < floor.frame.height; ++iy)
    for (int ix = 0; ix < floor.frame.width; ++ix)
      if (floor.pose(ix, iy)) coarse_(ix / step_, iy / step_) = 1;
  coarse_nodes_.resize(coarse_.cells.size());
  BuildBlocks();
}

// Connected pieces of blocks and the ways between all of them; blocks grow until the table is
// small.
void Ways::BuildBlocks() {
  int side = 8;  // coarse cells a block
  std::vector<std::vector<std::pair<int, float>>> graph;
  for (;; side = side * 3 / 2) {
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
            const Cell n{c.ix + d.ix, c.iy + d.iy};
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
  graph.resize(block_at_.size());
  for (int iy = 0; iy < coarse_.height; ++iy)
    for (int ix = 0; ix < coarse_.width; ++ix) {
      if (!coarse_(ix, iy)) continue;
      const int a = block_of_(ix, iy);
      for (const Cell d : kNeighbours) {
        const Cell n{ix + d.ix, iy + d.iy};
        if (!coarse_.Inside(n) || !coarse_(n) || block_of_(n) == a) continue;
        const int b = block_of_(n);
        auto& edges = graph[static_cast<std::size_t>(a)];
        if (std::none_of(edges.begin(), edges.end(), [b](const auto& e) { return e.first == b; }))
          edges.push_back({b, static_cast<float>((block_at_[static_cast<std::size_t>(a)] -
                                                  block_at_[static_cast<std::size_t>(b)])
                                                     .norm())});
      }
    }
  const std::size_t n = block_at_.size();
  block_distance_.assign(n * n, std::numeric_limits<float>::infinity());
  std::priority_queue<std::pair<float, int>, std::vector<std::pair<float, int>>, std::greater<>>
      queue;
  for (std::size_t from = 0; from < n; ++from) {
    float* distance = &block_distance_[from * n];
    distance[from] = 0;
    queue.push({0.0f, static_cast<int>(from)});
    while (!queue.empty()) {
      const auto [d, a] = queue.top();
      queue.pop();
      if (d > distance[a]) continue;
      for (const auto& [b, length] : graph[static_cast<std::size_t>(a)])
        if (d + length < distance[b]) {
          distance[b] = d + length;
          queue.push({distance[b], b});
        }
    }
  }
}

Cell Ways::NearestPose(const Vec2& p, double reach) const {
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

bool Ways::Search(Cell from, Cell to, std::vector<Cell>& cells) {
  const Grid<std::uint8_t>& pose = floor_.pose;
  const int goal = static_cast<int>(pose.Index(to.ix, to.iy));
  ++stamp_;
  heap_.clear();
  const auto relax = [&](int ix, int iy, float cost, int parent) {
    const int id = static_cast<int>(pose.Index(ix, iy));
    Node& node = nodes_[static_cast<std::size_t>(id)];
    if (node.stamp == stamp_ && node.cost <= cost) return;
    node = {cost, parent, stamp_};
    heap_.push_back({cost + Octile(ix - to.ix, iy - to.iy), id});
    std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
  };
  relax(from.ix, from.iy, 0, -1);
  while (!heap_.empty()) {
    std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
    const auto [estimate, id] = heap_.back();
    heap_.pop_back();
    const Cell c{id % pose.width, id / pose.width};
    const float cost = nodes_[static_cast<std::size_t>(id)].cost;
    if (estimate > cost + Octile(c.ix - to.ix, c.iy - to.iy) + 1e-3f) continue;
    if (id == goal) {
      for (int at = goal; at >= 0; at = nodes_[static_cast<std::size_t>(at)].parent)
        cells.push_back({at % pose.width, at / pose.width});
      std::reverse(cells.begin(), cells.end());
      return true;
    }
    for (const Cell d : kNeighbours) {
      const int ix = c.ix + d.ix, iy = c.iy + d.iy;
      if (!pose(ix, iy)) continue;
      const bool diagonal = d.ix != 0 && d.iy != 0;
      // A footprint would scrape what blocks the cells beside; a circle clears it by less than
      // `tolerance`.
      if (diagonal && floor_.clears_footprint && !(pose(ix, c.iy) && pose(c.ix, iy))) continue;
      relax(ix, iy, cost + (diagonal ? kDiagonal : 1.0f), id);
    }
  }
  return false;
}

Polyline Ways::Route(const Vec2& a, const Vec2& b) {
  if (floor_.Sees(a, b)) return {a, b};
  const Cell from = NearestPose(a, kOffPose), to = NearestPose(b, kOffPose);
  std::vector<Cell> cells;
  if (from.ix < 0 || to.ix < 0 || !Search(from, to, cells)) return {};
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

double Ways::CoarseDistance(int from, int to) {
  ++coarse_stamp_;
  heap_.clear();
  const Cell goal{to % coarse_.width, to / coarse_.width};
  const auto relax = [&](int ix, int iy, float cost) {
    const int id = static_cast<int>(coarse_.Index(ix, iy));
    Node& node = coarse_nodes_[static_cast<std::size_t>(id)];
    if (node.stamp == coarse_stamp_ && node.cost <= cost) return;
    node = {cost, -1, coarse_stamp_};
    heap_.push_back({cost + Octile(ix - goal.ix, iy - goal.iy), id});
    std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
  };
  relax(from % coarse_.width, from / coarse_.width, 0);
  while (!heap_.empty()) {
    std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
    const int id = heap_.back().second;
    heap_.pop_back();
    --coarse_budget_;
    const float cost = coarse_nodes_[static_cast<std::size_t>(id)].cost;
    if (id == to) return static_cast<double>(cost) * step_;
    const Cell c{id % coarse_.width, id / coarse_.width};
    for (const Cell d : kNeighbours) {
      const Cell n{c.ix + d.ix, c.iy + d.iy};
      if (coarse_.Inside(n) && coarse_(n))
        relax(n.ix, n.iy, cost + (d.ix != 0 && d.iy != 0 ? kDiagonal : 1.0f));
    }
  }
  return std::numeric_limits<double>::infinity();
}

int Ways::CoarseAt(const Vec2& p) const {
  const Cell near = NearestPose(p, kOffPose);
  return static_cast<int>(
      coarse_.Index(std::max(0, near.ix) / step_, std::max(0, near.iy) / step_));
}

void Ways::IndexPlaces(const std::vector<Vec2>& places) {
  places_ = places;
  place_cell_.clear();
  for (const Vec2& p : places) place_cell_.push_back(CoarseAt(p));
  first_place_.assign(coarse_.cells.size() + 1, 0);
  for (const int c : place_cell_) ++first_place_[static_cast<std::size_t>(c) + 1];
  std::partial_sum(first_place_.begin(), first_place_.end(), first_place_.begin());
  place_list_.resize(places.size());
  std::vector<int> next = first_place_;
  for (std::size_t i = 0; i < places.size(); ++i)
    place_list_[static_cast<std::size_t>(next[static_cast<std::size_t>(place_cell_[i])]++)] =
        static_cast<int>(i);
}

// Dijkstra with costs 5 and 7 in a ring of buckets (Dial 1969).
std::vector<Ways::Near> Ways::NearestPlaces(int place, std::size_t count) {
  constexpr int kStraight = 5, kAslant = 7;
  ++coarse_stamp_;
  std::vector<Near> found;
  for (auto& bucket : buckets_) bucket.clear();
  const int start = place_cell_[static_cast<std::size_t>(place)];
  coarse_nodes_[static_cast<std::size_t>(start)] = {0, -1, coarse_stamp_};
  buckets_[0].push_back(start);
  int waiting = 1;
  for (int cost = 0; waiting > 0 && found.size() < count; ++cost) {
    auto& bucket = buckets_[static_cast<std::size_t>(cost) % buckets_.size()];
    for (std::size_t i = 0; i < bucket.size(); ++i) {
      const int id = bucket[i];
      --waiting;
      if (coarse_nodes_[static_cast<std::size_t>(id)].cost != static_cast<float>(cost)) continue;
      for (int k = first_place_[static_cast<std::size_t>(id)];
           k < first_place_[static_cast<std::size_t>(id) + 1]; ++k)
        if (const int other = place_list_[static_cast<std::size_t>(k)]; other != place) {
          const Vec2 &a = places_[static_cast<std::size_t>(place)],
                     &b = places_[static_cast<std::size_t>(other)];
          const double straight = (b - a).norm();
          const double way = static_cast<double>(cost) / kStraight * step_;
          found.push_back({floor_.Sees(a, b) ? straight : std::max(straight, way), other});
        }
      const Cell c{id % coarse_.width, id / coarse_.width};
      for (const Cell d : kNeighbours) {
        const Cell n{c.ix + d.ix, c.iy + d.iy};
        if (!coarse_.Inside(n) || !coarse_(n)) continue;
        const int next = cost + (d.ix != 0 && d.iy != 0 ? kAslant : kStraight);
        const int to = static_cast<int>(coarse_.Index(n.ix, n.iy));
        Node& node = coarse_nodes_[static_cast<std::size_t>(to)];
        if (node.stamp == coarse_stamp_ && node.cost <= static_cast<float>(next)) continue;
        node = {static_cast<float>(next), -1, coarse_stamp_};
        buckets_[static_cast<std::size_t>(next) % buckets_.size()].push_back(to);
        ++waiting;
      }
    }
    bucket.clear();
  }
  return found;
}

double Ways::Distance(const Vec2& a, const Vec2& b) {
  const double straight = (b - a).norm();
  if (straight < 2.0 * block_ && floor_.Sees(a, b)) return straight;
  const int ca = CoarseAt(a), cb = CoarseAt(b);
  const int block_a = block_of_.cells[static_cast<std::size_t>(ca)];
  const int block_b = block_of_.cells[static_cast<std::size_t>(cb)];
  if (block_a < 0 || block_b < 0) return std::numeric_limits<double>::infinity();
  const double table =
      static_cast<double>(block_distance_[static_cast<std::size_t>(block_a) * block_at_.size() +
                                          static_cast<std::size_t>(block_b)]);
  if (table > 3.0 * block_ || coarse_budget_ <= 0) return std::max(straight, table);
  return std::max(straight, CoarseDistance(ca, cb));
}

Polyline JoinByRoutes(Ways& ways, const std::vector<Polyline>& lines) {
  Polyline path;
  for (const Polyline& line : lines) {
    if (line.empty()) continue;
    if (!path.empty()) {
      const Polyline route = ways.Route(path.back(), line.front());
      if (route.empty()) continue;  // cut off: not a place to go to
      path.insert(path.end(), route.begin(), route.end());
    }
    path.insert(path.end(), line.begin(), line.end());
  }
  return path;
}

}  // namespace floorproof
