// SPDX-License-Identifier: Apache-2.0
// The tour is made region by region, between two portals each (portals.h).
//
// (1) Dead ends are set aside. (2) A maximum 2-matching of the other cells makes few paths and many
// cycles (two_matching.h). (3) Each cycle is merged into a component beside it: an edge of each is
// taken out and two others are put in. That costs nothing where the four cells form a square, else
// two steps. (4) The components that are left are joined at their ends, the nearest ones first. All
// ends flood the floor at once; where two floods meet, two ends can be joined. Each round makes
// many joints, as Boruvka's algorithm does for trees. (5) Dead ends come back as detours. Not done:
// looking for the best tour; that is the local search's part.
#include "planners/walk/tour_construction.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

#include "planners/walk/portals.h"
#include "planners/walk/two_matching.h"

namespace floorproof {
namespace {

class TourConstruction {
 public:
  TourConstruction(const WalkGraph& graph, const std::vector<std::uint8_t>& required, int start,
                   int end, const std::vector<int>& regions)
      : graph_(graph),
        regions_(regions),
        start_(start),
        end_(end),
        end_apart_(end >= 0 && graph.region[Z(end)] != regions.back()),
        core_(required),
        spare_(graph.size(), 0),
        edges_(graph.size(), {-1, -1}),
        component_(graph.size()),
        is_cycle_(graph.size(), 0) {
    // Where other regions come after the end's, the end is visited once all is covered.
    if (end_apart_) core_[Z(end)] = 0;
    SetAsideDeadEnds();
    if (end < 0) EndInDeepestDeadEnd();
    portals_ = FindPortals(graph, core_, regions, start_, end_apart_ ? -1 : end_);
    MatchCells();
    FindComponents();
    while (MergeCycles()) {
    }
    PartPortals();
    while (JoinEnds()) {
    }
    for (auto it = dead_ends_.rbegin(); it != dead_ends_.rend(); ++it)
      Detour(it->first, it->second);
  }

  std::vector<int> Read() const {
    std::vector<int> order;
    std::vector<std::uint8_t> done(graph_.size(), 0);
    const auto follow = [&](int at) {
      while (at >= 0) {
        done[Z(at)] = 1;
        order.push_back(at);
        const auto [a, b] = edges_[Z(at)];
        at = a >= 0 && !done[Z(a)] ? a : b >= 0 && !done[Z(b)] ? b : -1;
      }
    };
    for (const int region : regions_) {
      const auto [entry, exit] = portals_[Z(region)];
      follow(entry);
      if (exit < 0 || done[Z(exit)]) continue;
      const auto middle = static_cast<std::ptrdiff_t>(order.size());
      follow(exit);
      std::reverse(order.begin() + middle, order.end());
    }
    if (end_apart_) order.push_back(end_);
    return order;
  }

 private:
  int Count() const { return static_cast<int>(graph_.size()); }
  int Region(int at) const { return graph_.region[Z(at)]; }
  bool AreCoreNeighbours(int a, int b) const { return core_[Z(b)] && Region(a) == Region(b); }
  int Steps(int a, int b) const {
    const Cell p = graph_.CellAt(a), q = graph_.CellAt(b);
    return std::abs(p.ix - q.ix) + std::abs(p.iy - q.iy);
  }

  void SetAsideDeadEnds() {
    std::vector<int> stack, degree(graph_.size(), 0), left(graph_.adjacent.size(), 0);
    for (int at = 0; at < Count(); ++at) {
      if (!core_[Z(at)]) continue;
      ++left[Z(Region(at))];
      for (const int to : graph_.Neighbours(at)) degree[Z(at)] += AreCoreNeighbours(at, to);
      if (degree[Z(at)] == 1) stack.push_back(at);
    }
    while (!stack.empty()) {
      const int at = stack.back();
      stack.pop_back();
      // Two cells stay: a region may need two portals.
      if (degree[Z(at)] != 1 || at == start_ || at == end_ || left[Z(Region(at))] <= 2) continue;
      --left[Z(Region(at))];
      for (const int to : graph_.Neighbours(at))
        if (AreCoreNeighbours(at, to)) {
          core_[Z(at)] = 0;
          dead_ends_.push_back({at, to});
          if (--degree[Z(to)] == 1) stack.push_back(to);
          break;
        }
    }
  }

  // A tour that may end anywhere ends in the deepest dead end: the way out of it is saved.
  void EndInDeepestDeadEnd() {
    std::vector<int> depth(graph_.size(), 0);
    int deepest = -1;
    for (auto it = dead_ends_.rbegin(); it != dead_ends_.rend(); ++it) {
      const auto [at, on] = *it;
      depth[Z(at)] = depth[Z(on)] + 1;
      if (Region(at) == regions_.back() && (deepest < 0 || depth[Z(at)] > depth[Z(deepest)]))
        deepest = at;
    }
    if (deepest < 0) return;
    end_ = deepest;
    for (const auto& [at, on] : dead_ends_) core_[Z(at)] = 1;
    dead_ends_.clear();
    SetAsideDeadEnds();
  }

  void MatchCells() {
    std::vector<std::int32_t> kind(graph_.size(), 0);
    for (int at = 0; at < Count(); ++at)
      if (core_[Z(at)]) kind[Z(at)] = Region(at) + 1, spare_[Z(at)] = 2;
    for (const int region : regions_)
      for (const int portal : {portals_[Z(region)].entry, portals_[Z(region)].exit})
        if (portal >= 0) --spare_[Z(portal)];
    TwoMatching matching(std::move(kind), graph_.stride, spare_);
    matching.PairDeficientCells();
    for (int at = 0; at < Count(); ++at) {
      if (!core_[Z(at)]) continue;
      for (const int to : matching.Partners(at))
        if (to > at) AddEdge(at, to);
    }
  }

  // At most two edges a cell; a portal has one, and another region on its other side.
  void AddEdge(int a, int b) {
    for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, a}}) {
      edges_[Z(from)][edges_[Z(from)][0] < 0 ? 0 : 1] = to;
      --spare_[Z(from)];
    }
  }
  void RemoveEdge(int a, int b) {
    for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, a}}) {
      auto& cells = edges_[Z(from)];
      cells = {cells[0] == to ? cells[1] : cells[0], -1};
      ++spare_[Z(from)];
    }
  }

  // Cells that edges connect.
  void FindComponents() {
    std::iota(component_.begin(), component_.end(), 0);
    std::fill(is_cycle_.begin(), is_cycle_.end(), 1);
    for (int at = 0; at < Count(); ++at) {
      if (edges_[Z(at)][1] < 0) is_cycle_[Z(Component(at))] = 0;
      for (const int to : edges_[Z(at)])
        if (to >= 0) Merge(at, to);
    }
  }
  int Component(int at) {
    while (component_[Z(at)] != at) at = component_[Z(at)] = component_[Z(component_[Z(at)])];
    return at;
  }
  void Merge(int a, int b) {
    a = Component(a), b = Component(b);
    is_cycle_[Z(a)] = is_cycle_[Z(a)] && is_cycle_[Z(b)];
    component_[Z(b)] = a;
  }

  // One round: each cycle is merged into a component beside it, if there is one. A component that
  // has grown waits for the next round. Whether any was merged.
  bool MergeCycles() {
    bool any = false;
    std::vector<std::uint8_t> looked_at(graph_.size(), 0);
    for (int first = 0; first < Count(); ++first) {
      if (!core_[Z(first)] || !is_cycle_[Z(Component(first))] || looked_at[Z(Component(first))])
        continue;
      int least = std::numeric_limits<int>::max();
      std::array<int, 4> best{};
      int before = edges_[Z(first)][1], at = first;
      do {
        for (const int next : graph_.Neighbours(at)) {
          if (!AreCoreNeighbours(at, next) || Component(next) == Component(at)) continue;
          for (const int a : edges_[Z(at)])
            for (const int b : edges_[Z(next)]) {
              if (b < 0) continue;
              const int more = Steps(a, b) - Steps(a, at) - Steps(b, next);
              if (more < least) least = more, best = {at, a, next, b};
            }
        }
        const auto [p, q] = edges_[Z(at)];
        before = std::exchange(at, p == before ? q : p);
      } while (at != first);
      looked_at[Z(Component(first))] = 1;
      if (least == std::numeric_limits<int>::max()) continue;
      const auto& [c, a, d, b] = best;
      RemoveEdge(c, a);
      RemoveEdge(d, b);
      AddEdge(c, d);
      AddEdge(a, b);
      Merge(c, d);
      looked_at[Z(Component(c))] = 1;
      any = true;
    }
    return any;
  }

  // Where both portals are the ends of one path, and other components still have to come between,
  // cuts the exit off.
  void PartPortals() {
    std::vector<std::uint8_t> has_others(graph_.adjacent.size(), 0);
    for (int at = 0; at < Count(); ++at)
      if (core_[Z(at)] && Component(at) != Component(portals_[Z(Region(at))].entry))
        has_others[Z(Region(at))] = 1;
    for (const int region : regions_) {
      const auto [entry, exit] = portals_[Z(region)];
      if (has_others[Z(region)] && exit >= 0 && exit != entry &&
          Component(entry) == Component(exit))
        RemoveEdge(exit, edges_[Z(exit)][0]);
    }
    FindComponents();
  }

  bool IsEnd(int at) { return spare_[Z(at)] > 0 || is_cycle_[Z(Component(at))]; }
  bool MayJoin(int a, int b) {
    const int p = Component(a), q = Component(b);
    const auto [entry, exit] = portals_[Z(Region(a))];
    if (p == q || exit < 0) return p != q;
    const int s = Component(entry), e = Component(exit);
    return !(p == s && q == e) && !(p == e && q == s);
  }

  // From all ends at once: the nearest end to each cell, in its region, and the steps from there.
  void Flood(std::vector<int>& nearest, std::vector<int>& steps) {
    std::vector<int> queue;
    for (int at = 0; at < Count(); ++at)
      if (core_[Z(at)] && IsEnd(at)) nearest[Z(at)] = at, queue.push_back(at);
    for (std::size_t k = 0; k < queue.size(); ++k)
      for (const int next : graph_.Neighbours(queue[k])) {
        if (Region(next) != Region(queue[k]) || nearest[Z(next)] >= 0) continue;
        nearest[Z(next)] = nearest[Z(queue[k])];
        steps[Z(next)] = steps[Z(queue[k])] + 1;
        queue.push_back(next);
      }
  }

  // One round of joints. Whether there were any.
  bool JoinEnds() {
    std::vector<int> nearest(graph_.size(), -1), steps(graph_.size(), 0);
    Flood(nearest, steps);
    std::vector<std::tuple<int, int, int>> joints;  // steps, ends
    for (int at = 0; at < Count(); ++at) {
      if (nearest[Z(at)] < 0) continue;
      for (const int next : {at + 1, at + graph_.stride}) {
        if (Region(next) != Region(at)) continue;
        const auto [a, b] = std::minmax(nearest[Z(at)], nearest[Z(next)]);
        if (MayJoin(a, b)) joints.push_back({steps[Z(at)] + steps[Z(next)] + 1, a, b});
      }
    }
    std::sort(joints.begin(), joints.end());
    for (const auto& [apart, a, b] : joints) {
      if (!MayJoin(a, b) || !IsEnd(a) || !IsEnd(b)) continue;
      for (const int end : {a, b})
        if (is_cycle_[Z(Component(end))]) {
          is_cycle_[Z(Component(end))] = 0;
          RemoveEdge(end, edges_[Z(end)][0]);
        }
      AddEdge(a, b);
      Merge(a, b);
    }
    return !joints.empty();
  }

  // Puts a cell of a dead end behind the cell that leads into it.
  void Detour(int at, int on) {
    spare_[Z(at)] = 2;
    if (spare_[Z(on)] <= 0) {
      const int next = edges_[Z(on)][edges_[Z(on)][1] >= 0 ? 1 : 0];
      if (next >= 0) {
        RemoveEdge(on, next);
        AddEdge(at, next);
      }
    }
    AddEdge(on, at);
  }

  const WalkGraph& graph_;
  const std::vector<int>& regions_;
  int start_, end_;
  bool end_apart_;
  std::vector<std::uint8_t> core_;  // by cell: required, and in no dead end
  std::vector<std::pair<int, int>>
      dead_ends_;                          // outermost first, each with the cell that leads into it
  std::vector<Portals> portals_;           // by region
  std::vector<int> spare_;                 // by cell: how many more edges it may have
  std::vector<std::array<int, 2>> edges_;  // by cell: to where; -1: none
  std::vector<int> component_;
  std::vector<std::uint8_t> is_cycle_;  // by component
};

}  // namespace

std::vector<int> ConstructTour(const WalkGraph& graph, const std::vector<std::uint8_t>& required,
                               int start, int end, const std::vector<int>& regions) {
  return TourConstruction(graph, required, start, end, regions).Read();
}

}  // namespace floorproof
