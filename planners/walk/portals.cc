// SPDX-License-Identifier: Apache-2.0
// Between two regions in turn: Dijkstra's search from all cells on the edge of the first one at
// once, to the first cell of the second one. So the border is crossed where that costs least.
#include "planners/walk/portals.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "planners/search/best_first.h"

namespace floorproof {
namespace {

// Cells that all searches together may look at, in cells of the floor. After that any cells are
// portals: on a floor in very many pieces the searches would take too long.
constexpr std::int64_t kMaxPops = 40;

class PortalFinder {
 public:
  PortalFinder(const WalkGraph& graph, const std::vector<std::uint8_t>& core)
      : graph_(graph),
        core_(core),
        cells_(graph.adjacent.size()),
        search_(graph.size()),
        pops_left_(kMaxPops * static_cast<std::int64_t>(graph.size())) {
    for (int at = 0; at < static_cast<int>(graph.size()); ++at)
      if (core[Z(at)]) cells_[Z(graph.region[Z(at)])].push_back(at);
  }

  // The cell to leave `region` by, and the one to enter `to_region` by. The first is not `entry`
  // and the second not `end` where their regions have other cells.
  std::pair<int, int> CheapestCrossing(int region, int entry, int to_region, int end) {
    const std::vector<int>&here = cells_[Z(region)], &there = cells_[Z(to_region)];
    if (here.size() == 1) entry = -1;
    if (there.size() == 1) end = -1;
    search_.Begin();
    for (const int at : here)
      if (at != entry && IsOnEdge(at)) search_.Reach(at, 0);
    bool spent = false;
    const int entered = search_.Run(
        [&](const auto& at) {
          spent = search_.pops() > pops_left_;
          return spent ||
                 (graph_.region[Z(at.node)] == to_region && core_[Z(at.node)] && at.node != end);
        },
        [&](const auto& at, const auto& reach) {
          for (const int to : graph_.Neighbours(at.node))
            if (graph_.region[Z(to)] >= 0) reach(to, at.cost + graph_.StepCost(at.node, to));
        });
    pops_left_ -= search_.pops();
    if (entered >= 0 && !spent) return {search_.PathTo(entered).front(), entered};
    const auto any_but = [](const std::vector<int>& cells, int cell) {
      return cells.front() != cell ? cells.front() : cells.back();
    };
    return {any_but(here, entry), any_but(there, end)};
  }

 private:
  bool IsOnEdge(int at) const {
    const auto neighbours = graph_.Neighbours(at);
    return std::any_of(neighbours.begin(), neighbours.end(), [&](int to) {
      return !core_[Z(to)] || graph_.region[Z(to)] != graph_.region[Z(at)];
    });
  }

  const WalkGraph& graph_;
  const std::vector<std::uint8_t>& core_;
  std::vector<std::vector<int>> cells_;  // by region: those of the core
  BestFirstSearch<std::int64_t> search_;
  std::int64_t pops_left_;
};

}  // namespace

std::vector<Portals> FindPortals(const WalkGraph& graph, const std::vector<std::uint8_t>& core,
                                 const std::vector<int>& regions, int start, int end) {
  PortalFinder finder(graph, core);
  std::vector<Portals> portals(graph.adjacent.size());
  int entry = start;
  for (std::size_t k = 0; k < regions.size(); ++k) {
    int exit = end, next = -1;
    if (k + 1 < regions.size())
      std::tie(exit, next) = finder.CheapestCrossing(regions[k], entry, regions[k + 1], end);
    portals[Z(regions[k])] = {entry, exit};
    entry = next;
  }
  return portals;
}

}  // namespace floorproof
