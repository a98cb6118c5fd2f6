// SPDX-License-Identifier: Apache-2.0
// A* (Hart, Nilsson & Raphael 1968). The bound ahead counts the regions still to be left, over the
// graph of regions, and straight steps: a search for a way across terrain does not flood the floor
// on this side first.
#include "planners/walk/walk_costs.h"

#include <algorithm>
#include <cstdlib>

#include "planners/lines/index.h"

namespace floorproof {
namespace {

constexpr int kTabled = 500;                          // places
constexpr std::size_t kPairs = std::size_t{1} << 18;  // remembered
constexpr int kLookedAt = 400;                        // cells, for the near ones of a place
constexpr std::int64_t kPopWork = 3;

}  // namespace

WalkCosts::WalkCosts(const WalkGraph& graph, const std::vector<int>& places)
    : graph_(graph),
      places_(places),
      n_(static_cast<int>(places.size())),
      place_at_(graph.size(), -1),
      nodes_(graph.size()),
      to_edge_(graph.size(), 0),
      borders_(graph) {
  for (int a = n_ - 1; a >= 0; --a) place_at_[Z(places[Z(a)])] = a;
  if (graph.touching.size() > 1) MeasureToEdge();
  if (n_ <= kTabled) {
    table_.resize(Z(n_) * Z(n_));
    filled_.resize(Z(n_));
  } else {
    pairs_.resize(kPairs);
  }
}

// Of each cell the least that the way to its region's edge costs, the cell itself left out.
void WalkCosts::MeasureToEdge() {
  ++stamp_;
  heap_.clear();
  for (int at = 0; at < static_cast<int>(graph_.size()); ++at) {
    if (graph_.region[Z(at)] < 0) continue;
    for (const int next : graph_.Beside(at))
      if (graph_.region[Z(next)] >= 0 && graph_.terrain[Z(next)] != graph_.terrain[Z(at)] &&
          Reach(at, 0, -1))
        Push({0, 0, at});
  }
  for (Open open; Pop(open);) {
    to_edge_[Z(open.at)] = open.bound;
    for (const int next : graph_.Beside(open.at))
      if (graph_.region[Z(next)] == graph_.region[Z(open.at)]) {
        const std::int64_t there = open.bound + graph_.weight[Z(open.at)];
        if (Reach(next, there, open.at)) Push({there, 0, next});
      }
  }
}

// Borders from one cell's region to all others, as far as it matters.
const std::uint16_t* WalkCosts::BordersTo(int to, int from) {
  work -= borders_.work;
  const std::uint16_t* borders = borders_.To(graph_.region[Z(to)], graph_.region[Z(from)]);
  work += borders_.work;
  return borders;
}

std::int64_t WalkCosts::Ahead(int from, int to, const std::uint16_t* borders) const {
  const int s = graph_.stride;
  const int steps = std::abs(from % s - to % s) + std::abs(from / s - to / s);
  const std::int64_t straight = std::max(0, steps - 1) * graph_.least_weight;
  const int left = borders[graph_.region[Z(from)]];
  if (left == 0) return straight;
  return graph_.half_crossing * left + std::max(straight, to_edge_[Z(from)] + to_edge_[Z(to)]);
}

std::int64_t WalkCosts::AtLeast(int a, int b) {
  const int from = places_[Z(a)], to = places_[Z(b)];
  return Ahead(from, to, BordersTo(to, from));
}

std::int64_t WalkCosts::EndCost(int a) const {
  return graph_.terrain[Z(places_[Z(a)])] ? graph_.half_crossing : 0;
}

std::int64_t WalkCosts::Cost(int a, int b, std::int64_t limit) {
  const int from = places_[Z(a)], to = places_[Z(b)], apart = std::abs(from - to);
  if (apart == 1 || apart == graph_.stride) return graph_.StepCost(from, to) - graph_.weight[Z(to)];
  if (n_ <= kTabled) {
    if (!filled_[Z(a)]) FillRow(a);
    return table_[Z(a) * Z(n_) + Z(b)];
  }
  const std::uint64_t ab =
      static_cast<std::uint64_t>(std::min(a, b)) << 32 | static_cast<std::uint32_t>(std::max(a, b));
  Pair& pair = pairs_[(ab * 0x9e3779b97f4a7c15ULL) >> 46];
  if (pair.ab == ab && (pair.exact || pair.cost >= limit)) return pair.cost;
  const std::int64_t cost = Search(from, to, limit);
  pair = {ab, cost, cost < limit};
  return cost;
}

bool WalkCosts::Later(const Open& a, const Open& b) {
  if (a.bound != b.bound) return a.bound > b.bound;
  return a.rest != b.rest ? a.rest > b.rest : a.at > b.at;
}

void WalkCosts::Begin(int from) {
  ++stamp_;
  heap_.clear();
  nodes_[Z(from)] = {0, -1, stamp_};
}

void WalkCosts::Push(const Open& open) {
  heap_.push_back(open);
  std::push_heap(heap_.begin(), heap_.end(), Later);
}

bool WalkCosts::Pop(Open& open) {
  while (!heap_.empty()) {
    std::pop_heap(heap_.begin(), heap_.end(), Later);
    open = heap_.back();
    heap_.pop_back();
    work += kPopWork;
    if (open.bound - open.rest == nodes_[Z(open.at)].cost) return true;
  }
  return false;
}

bool WalkCosts::Reach(int at, std::int64_t cost, int parent) {
  Node& node = nodes_[Z(at)];
  if (node.stamp == stamp_ && node.cost <= cost) return false;
  node = {cost, parent, stamp_};
  return true;
}

std::int64_t WalkCosts::Search(int from, int to, std::int64_t limit) {
  const std::uint16_t* borders = BordersTo(to, from);
  Begin(from);
  const std::int64_t all = Ahead(from, to, borders);
  Push({all, all, from});
  for (Open open; Pop(open);) {
    if (open.bound >= limit) return limit;
    if (open.at == to) return open.bound;
    const std::int64_t cost = open.bound - open.rest;
    for (const int next : graph_.Beside(open.at)) {
      if (graph_.region[Z(next)] < 0) continue;
      std::int64_t there = cost + graph_.StepCost(open.at, next);
      if (next == to) there -= graph_.weight[Z(to)];
      if (!Reach(next, there, open.at)) continue;
      const std::int64_t rest = Ahead(next, to, borders);
      Push({there + rest, rest, next});
    }
  }
  return limit;
}

template <class Visit>
void WalkCosts::Spread(int from, const Visit& visit) {
  Begin(from);
  Push({0, 0, from});
  for (Open open; Pop(open);) {
    if (open.at != from && !visit(place_at_[Z(open.at)], open.bound - graph_.weight[Z(open.at)]))
      return;
    for (const int next : graph_.Beside(open.at)) {
      if (graph_.region[Z(next)] < 0) continue;
      const std::int64_t there = open.bound + graph_.StepCost(open.at, next);
      if (Reach(next, there, open.at)) Push({there, 0, next});
    }
  }
}

void WalkCosts::FillRow(int a) {
  std::int64_t* row = &table_[Z(a) * Z(n_)];
  filled_[Z(a)] = 1;
  Spread(places_[Z(a)], [row](int b, std::int64_t cost) {
    if (b >= 0) row[b] = cost;
    return true;
  });
  row[n_ - 1] = row[place_at_[Z(places_[Z(n_ - 1)])]];  // where the walk ends on its start
}

NearLinks WalkCosts::Near(std::size_t count) {
  NearLinks near;
  near.links.reserve(Z(n_) * count);
  near.first.reserve(Z(n_) + 1);
  for (const int place : places_) {
    const std::size_t first = near.links.size();
    int looked_at = 0;
    Spread(place, [&](int b, std::int64_t cost) {
      if (b >= 0) near.links.push_back({cost, b});
      return near.links.size() < first + count && ++looked_at < kLookedAt;
    });
    std::stable_sort(near.links.begin() + static_cast<std::ptrdiff_t>(first), near.links.end(),
                     [](const Link& x, const Link& y) { return x.cost < y.cost; });
    near.first.push_back(near.links.size());
  }
  return near;
}

void WalkCosts::AppendWay(int a, int b, std::vector<int>& cells) {
  const int from = places_[Z(a)], to = places_[Z(b)];
  Search(from, to, kUnlimited);
  const auto first = static_cast<std::ptrdiff_t>(cells.size());
  for (int at = to; at != from; at = nodes_[Z(at)].parent) cells.push_back(at);
  std::reverse(cells.begin() + first, cells.end());
}

}  // namespace floorproof
