// SPDX-License-Identifier: Apache-2.0
// A* over the cells. Its lower bound counts the borders between regions that are still to be
// crossed (region_borders.h), each of which costs more than any way within regions, and the
// straight steps. So a search for a way across terrain does not flood the floor on this side first.
//
// With few places the costs of all pairs are tabled, by Dijkstra's search from each. With many
// places the pairs that were asked for last are remembered.
#include "planners/walk/walk_costs.h"

#include <algorithm>
#include <cstdlib>

namespace floorproof {
namespace {

constexpr int kTabled = 500;                          // places
constexpr std::size_t kPairs = std::size_t{1} << 18;  // remembered
constexpr int kLookedAt = 400;                        // cells, for the candidates of a place
constexpr std::int64_t kPopWork = 3;

}  // namespace

WalkCosts::WalkCosts(const WalkGraph& graph, const std::vector<int>& places)
    : graph_(graph),
      places_(places),
      n_(static_cast<int>(places.size())),
      place_at_(graph.size(), -1),
      search_(graph.size()),
      to_edge_(graph.size(), 0),
      borders_(graph) {
  for (int a = n_ - 1; a >= 0; --a) place_at_[Z(places[Z(a)])] = a;
  if (graph.adjacent.size() > 1) MeasureToEdge();
  if (n_ <= kTabled) {
    table_.resize(Z(n_) * Z(n_));
    filled_.resize(Z(n_));
  } else {
    pairs_.resize(kPairs);
  }
}

// The least that the way from each cell to the edge of its region costs, the cell itself left out.
void WalkCosts::MeasureToEdge() {
  search_.Begin();
  for (int at = 0; at < static_cast<int>(graph_.size()); ++at) {
    if (graph_.region[Z(at)] < 0) continue;
    for (const int next : graph_.Neighbours(at))
      if (graph_.region[Z(next)] >= 0 && graph_.terrain[Z(next)] != graph_.terrain[Z(at)])
        search_.Reach(at, 0);
  }
  search_.Run(
      [&](const auto& at) {
        to_edge_[Z(at.node)] = at.cost;
        return false;
      },
      [&](const auto& at, const auto& reach) {
        for (const int next : graph_.Neighbours(at.node))
          if (graph_.region[Z(next)] == graph_.region[Z(at.node)])
            reach(next, at.cost + graph_.weight[Z(at.node)]);
      });
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

// The cost of the cheapest way; `limit` where that is not below it.
std::int64_t WalkCosts::Search(int from, int to, std::int64_t limit) {
  const std::uint16_t* borders = BordersTo(to, from);
  const auto ahead = [&](int at) { return Ahead(at, to, borders); };
  search_.Begin();
  search_.Reach(from, 0, search_.kNone, ahead(from));
  std::int64_t cost = limit;
  search_.Run(
      ahead,
      [&](const auto& at) {
        if (at.node == to) cost = std::min(limit, at.cost);
        return at.node == to || at.bound >= limit;
      },
      [&](const auto& at, const auto& reach) {
        for (const int next : graph_.Neighbours(at.node)) {
          if (graph_.region[Z(next)] < 0) continue;
          const std::int64_t there = at.cost + graph_.StepCost(at.node, next);
          reach(next, next == to ? there - graph_.weight[Z(to)] : there);
        }
      });
  work += kPopWork * search_.pops();
  return cost;
}

template <class Visit>
void WalkCosts::Spread(int from, const Visit& visit) {
  search_.Begin();
  search_.Reach(from, 0);
  search_.Run(
      [&](const auto& at) {
        return at.node != from &&
               !visit(place_at_[Z(at.node)], at.cost - graph_.weight[Z(at.node)]);
      },
      [&](const auto& at, const auto& reach) {
        for (const int next : graph_.Neighbours(at.node))
          if (graph_.region[Z(next)] >= 0) reach(next, at.cost + graph_.StepCost(at.node, next));
      });
  work += kPopWork * search_.pops();
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

CandidateEdges WalkCosts::Candidates(std::size_t count) {
  CandidateEdges candidates;
  for (const int place : places_) {
    int looked_at = 0;
    Spread(place, [&](int b, std::int64_t cost) {
      if (b >= 0) candidates.Add({cost, b});
      return candidates.Open().size() < count && ++looked_at < kLookedAt;
    });
    std::ranges::stable_sort(candidates.Open(), {}, &CandidateEdge::cost);
    candidates.Close();
  }
  return candidates;
}

void WalkCosts::AppendWay(int a, int b, std::vector<int>& cells) {
  Search(places_[Z(a)], places_[Z(b)], kUnlimited);
  const std::vector<int> way = search_.PathTo(places_[Z(b)]);
  cells.insert(cells.end(), way.begin() + 1, way.end());
}

}  // namespace floorproof
