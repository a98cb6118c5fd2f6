// SPDX-License-Identifier: Apache-2.0
// Region by region, between two gates each: where the floor before is left most cheaply and where
// it is come to. Dead ends are set aside. A greatest 2-matching of the rest makes few paths and
// many rings; paths are joined (two_matching), and a ring is taken into what lies beside it, over a
// link of each: for nothing where those are two sides of a square, else for two steps. What is
// still apart is joined by its ends, the nearest first: all ends flood the floor at once, and where
// two floods meet lies a joint (as in Boruvka's tree, a round makes many). Dead ends come back as
// detours.
#include "planners/walk/first_order.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

#include "planners/lines/index.h"
#include "planners/walk/gates.h"
#include "planners/walk/two_matching.h"

namespace floorproof {
namespace {

class Weaver {
 public:
  Weaver(const WalkGraph& graph, const std::vector<std::uint8_t>& wanted, int start, int end,
         const std::vector<int>& regions)
      : graph_(graph),
        regions_(regions),
        start_(start),
        end_(end),
        end_apart_(end >= 0 && graph.region[Z(end)] != regions.back()),
        core_(wanted),
        room_(graph.size(), 0),
        linked_(graph.size(), {-1, -1}),
        group_(graph.size()),
        is_ring_(graph.size(), 0) {
    // An end in a region that others come after is gone to when all is covered.
    if (end_apart_) core_[Z(end)] = 0;
    SetAsideDeadEnds();
    if (end < 0) EndInDeepestDeadEnd();
    gates_ = FindGates(graph, core_, regions, start_, end_apart_ ? -1 : end_);
    LinkCells();
    FindGroups();
    while (TakeInRings()) {
    }
    PartGates();
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
        const auto [a, b] = linked_[Z(at)];
        at = a >= 0 && !done[Z(a)] ? a : b >= 0 && !done[Z(b)] ? b : -1;
      }
    };
    for (const int region : regions_) {
      const auto [entry, exit] = gates_[Z(region)];
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
  bool AreBeside(int a, int b) const { return core_[Z(b)] && Region(a) == Region(b); }
  int Steps(int a, int b) const {
    const Cell p = graph_.CellAt(a), q = graph_.CellAt(b);
    return std::abs(p.ix - q.ix) + std::abs(p.iy - q.iy);
  }

  void SetAsideDeadEnds() {
    std::vector<int> stack, ways(graph_.size(), 0), left(graph_.touching.size(), 0);
    for (int at = 0; at < Count(); ++at) {
      if (!core_[Z(at)]) continue;
      ++left[Z(Region(at))];
      for (const int to : graph_.Beside(at)) ways[Z(at)] += AreBeside(at, to);
      if (ways[Z(at)] == 1) stack.push_back(at);
    }
    while (!stack.empty()) {
      const int at = stack.back();
      stack.pop_back();
      // Two cells stay: a region may need two gates.
      if (ways[Z(at)] != 1 || at == start_ || at == end_ || left[Z(Region(at))] <= 2) continue;
      --left[Z(Region(at))];
      for (const int to : graph_.Beside(at))
        if (AreBeside(at, to)) {
          core_[Z(at)] = 0;
          dead_ends_.push_back({at, to});
          if (--ways[Z(to)] == 1) stack.push_back(to);
          break;
        }
    }
  }

  // What is not come out of again saves most there.
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

  void LinkCells() {
    std::vector<std::int32_t> kind(graph_.size(), 0);
    for (int at = 0; at < Count(); ++at)
      if (core_[Z(at)]) kind[Z(at)] = Region(at) + 1, room_[Z(at)] = 2;
    for (const int region : regions_)
      for (const int gate : {gates_[Z(region)].entry, gates_[Z(region)].exit})
        if (gate >= 0) --room_[Z(gate)];
    TwoMatching links(std::move(kind), graph_.stride, room_);
    links.PairEnds();
    for (int at = 0; at < Count(); ++at) {
      if (!core_[Z(at)]) continue;
      for (const int to : links.LinkedTo(at))
        if (to > at) Link(at, to);
    }
  }

  // At most two links a cell; a gate is linked on one side only.
  void Link(int a, int b) {
    for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, a}}) {
      linked_[Z(from)][linked_[Z(from)][0] < 0 ? 0 : 1] = to;
      --room_[Z(from)];
    }
  }
  void Unlink(int a, int b) {
    for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, a}}) {
      auto& cells = linked_[Z(from)];
      cells = {cells[0] == to ? cells[1] : cells[0], -1};
      ++room_[Z(from)];
    }
  }

  // Cells that hang together by links.
  void FindGroups() {
    std::iota(group_.begin(), group_.end(), 0);
    std::fill(is_ring_.begin(), is_ring_.end(), 1);
    for (int at = 0; at < Count(); ++at) {
      if (linked_[Z(at)][1] < 0) is_ring_[Z(Group(at))] = 0;
      for (const int to : linked_[Z(at)])
        if (to >= 0) Merge(at, to);
    }
  }
  int Group(int at) {
    while (group_[Z(at)] != at) at = group_[Z(at)] = group_[Z(group_[Z(at)])];
    return at;
  }
  void Merge(int a, int b) {
    a = Group(a), b = Group(b);
    is_ring_[Z(a)] = is_ring_[Z(a)] && is_ring_[Z(b)];
    group_[Z(b)] = a;
  }

  // Each ring into what lies beside it, if anything does; a ring that grows waits for the next
  // round.
  bool TakeInRings() {
    bool any = false;
    std::vector<std::uint8_t> looked_at(graph_.size(), 0);
    for (int first = 0; first < Count(); ++first) {
      if (!core_[Z(first)] || !is_ring_[Z(Group(first))] || looked_at[Z(Group(first))]) continue;
      int least = std::numeric_limits<int>::max();
      std::array<int, 4> best{};
      int before = linked_[Z(first)][1], at = first;
      do {
        for (const int next : graph_.Beside(at)) {
          if (!AreBeside(at, next) || Group(next) == Group(at)) continue;
          for (const int a : linked_[Z(at)])
            for (const int b : linked_[Z(next)]) {
              if (b < 0) continue;
              const int more = Steps(a, b) - Steps(a, at) - Steps(b, next);
              if (more < least) least = more, best = {at, a, next, b};
            }
        }
        const auto [p, q] = linked_[Z(at)];
        before = std::exchange(at, p == before ? q : p);
      } while (at != first);
      looked_at[Z(Group(first))] = 1;
      if (least == std::numeric_limits<int>::max()) continue;
      const auto& [c, a, d, b] = best;
      Unlink(c, a);
      Unlink(d, b);
      Link(c, d);
      Link(a, b);
      Merge(c, d);
      looked_at[Z(Group(c))] = 1;
      any = true;
    }
    return any;
  }

  // Where both gates are the ends of one path and others still have to come between, cuts the exit
  // off.
  void PartGates() {
    std::vector<std::uint8_t> has_others(graph_.touching.size(), 0);
    for (int at = 0; at < Count(); ++at)
      if (core_[Z(at)] && Group(at) != Group(gates_[Z(Region(at))].entry))
        has_others[Z(Region(at))] = 1;
    for (const int region : regions_) {
      const auto [entry, exit] = gates_[Z(region)];
      if (has_others[Z(region)] && exit >= 0 && exit != entry && Group(entry) == Group(exit))
        Unlink(exit, linked_[Z(exit)][0]);
    }
    FindGroups();
  }

  bool IsEnd(int at) { return room_[Z(at)] > 0 || is_ring_[Z(Group(at))]; }
  bool MayJoin(int a, int b) {
    const int p = Group(a), q = Group(b);
    const auto [entry, exit] = gates_[Z(Region(a))];
    if (p == q || exit < 0) return p != q;
    const int s = Group(entry), e = Group(exit);
    return !(p == s && q == e) && !(p == e && q == s);
  }

  // From all ends at once: of each cell the nearest one in its region, and how far it is.
  void Flood(std::vector<int>& nearest, std::vector<int>& steps) {
    std::vector<int> queue;
    for (int at = 0; at < Count(); ++at)
      if (core_[Z(at)] && IsEnd(at)) nearest[Z(at)] = at, queue.push_back(at);
    for (std::size_t k = 0; k < queue.size(); ++k)
      for (const int next : graph_.Beside(queue[k])) {
        if (Region(next) != Region(queue[k]) || nearest[Z(next)] >= 0) continue;
        nearest[Z(next)] = nearest[Z(queue[k])];
        steps[Z(next)] = steps[Z(queue[k])] + 1;
        queue.push_back(next);
      }
  }

  // One round of joints; whether there were any.
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
        if (is_ring_[Z(Group(end))]) {
          is_ring_[Z(Group(end))] = 0;
          Unlink(end, linked_[Z(end)][0]);
        }
      Link(a, b);
      Merge(a, b);
    }
    return !joints.empty();
  }

  // Puts a dead end behind the cell that it hangs on.
  void Detour(int at, int on) {
    room_[Z(at)] = 2;
    if (room_[Z(on)] <= 0) {
      const int next = linked_[Z(on)][linked_[Z(on)][1] >= 0 ? 1 : 0];
      if (next >= 0) {
        Unlink(on, next);
        Link(at, next);
      }
    }
    Link(on, at);
  }

  const WalkGraph& graph_;
  const std::vector<int>& regions_;
  int start_, end_;
  bool end_apart_;
  std::vector<std::uint8_t> core_;              // by cell: wanted, and no dead end
  std::vector<std::pair<int, int>> dead_ends_;  // outermost first, and the cells they hang on
  std::vector<Gates> gates_;                    // by region
  std::vector<int> room_;                       // by cell: for links
  std::vector<std::array<int, 2>> linked_;      // by cell; -1: none
  std::vector<int> group_;
  std::vector<std::uint8_t> is_ring_;  // by group
};

}  // namespace

std::vector<int> FirstOrder(const WalkGraph& graph, const std::vector<std::uint8_t>& wanted,
                            int start, int end, const std::vector<int>& regions) {
  return Weaver(graph, wanted, start, end, regions).Read();
}

}  // namespace floorproof
