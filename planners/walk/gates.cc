// SPDX-License-Identifier: Apache-2.0
// Dijkstra's search from all cells of a region at once, so that a crossing is where it costs least.
#include "planners/walk/gates.h"

#include <algorithm>
#include <queue>
#include <tuple>
#include <utility>

#include "planners/lines/index.h"

namespace floorproof {
namespace {

constexpr std::int64_t kLookedAt = 40;  // times all cells; then any cells must do

class GateFinder {
 public:
  GateFinder(const WalkGraph& graph, const std::vector<std::uint8_t>& core)
      : graph_(graph),
        core_(core),
        cells_(graph.touching.size()),
        reached_(graph.size()),
        most_looked_at_(kLookedAt * static_cast<std::int64_t>(graph.size())) {
    for (int at = 0; at < static_cast<int>(graph.size()); ++at)
      if (core[Z(at)]) cells_[Z(graph.region[Z(at)])].push_back(at);
  }

  // The cell to leave a region at, and the one to come to in another: not at `entry`, nor to `end`,
  // where the regions have more.
  std::pair<int, int> CheapestWay(int region, int entry, int to_region, int end) {
    const std::vector<int>&here = cells_[Z(region)], &there = cells_[Z(to_region)];
    if (here.size() == 1) entry = -1;
    if (there.size() == 1) end = -1;
    ++search_;
    open_ = {};
    for (const int at : here)
      if (at != entry && IsOnEdge(at)) Reach(at, 0, at);
    while (!open_.empty() && looked_at_++ < most_looked_at_) {
      const auto [cost, at] = open_.top();
      open_.pop();
      const int from = reached_[Z(at)].from;
      if (cost > reached_[Z(at)].cost) continue;
      if (graph_.region[Z(at)] == to_region && core_[Z(at)] && at != end) return {from, at};
      for (const int to : graph_.Beside(at))
        if (graph_.region[Z(to)] >= 0) Reach(to, cost + graph_.StepCost(at, to), from);
    }
    const auto any = [](const std::vector<int>& cells, int but) {
      return cells.front() != but ? cells.front() : cells.back();
    };
    return {any(here, entry), any(there, end)};
  }

 private:
  struct Reached {
    std::int64_t cost = 0;
    int from = -1, search = 0;
  };
  using Open = std::pair<std::int64_t, int>;  // cost, cell

  bool IsOnEdge(int at) const {
    const auto beside = graph_.Beside(at);
    return std::any_of(beside.begin(), beside.end(), [&](int to) {
      return !core_[Z(to)] || graph_.region[Z(to)] != graph_.region[Z(at)];
    });
  }
  void Reach(int at, std::int64_t cost, int from) {
    Reached& reached = reached_[Z(at)];
    if (reached.search == search_ && reached.cost <= cost) return;
    reached = {cost, from, search_};
    open_.push({cost, at});
  }

  const WalkGraph& graph_;
  const std::vector<std::uint8_t>& core_;
  std::vector<std::vector<int>> cells_;  // by region: its core
  std::vector<Reached> reached_;         // by cell
  int search_ = 0;
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open_;
  std::int64_t looked_at_ = 0, most_looked_at_;
};

}  // namespace

std::vector<Gates> FindGates(const WalkGraph& graph, const std::vector<std::uint8_t>& core,
                             const std::vector<int>& regions, int start, int end) {
  GateFinder finder(graph, core);
  std::vector<Gates> gates(graph.touching.size());
  int entry = start;
  for (std::size_t k = 0; k < regions.size(); ++k) {
    int exit = end, next = -1;
    if (k + 1 < regions.size())
      std::tie(exit, next) = finder.CheapestWay(regions[k], entry, regions[k + 1], end);
    gates[Z(regions[k])] = {entry, exit};
    entry = next;
  }
  return gates;
}

}  // namespace floorproof
