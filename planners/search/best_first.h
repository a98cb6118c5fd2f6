// SPDX-License-Identifier: Apache-2.0
// Best-first search over numbered nodes: Dijkstra's search (1959) and A* (Hart, Nilsson & Raphael
// 1968), with the costs, neighbours, lower bound and goal that the caller gives.
//
// A frontier holds the nodes that were reached, ordered by what they cost from the sources plus a
// lower bound on the way still ahead. The first one is settled, its neighbours are reached through
// it, and so on until the caller says stop. A node that is reached again for less comes back to the
// frontier, so the bound need not be consistent; entries that were overtaken are passed over.
//
// Equal bounds are ordered by a rule (Ties), never by chance: the same search gives the same tree.
// The memory is kept for the next search, which starts in constant time.
// Assumed: no negative costs. Not done: searching from both ends, or over more than 2^31 nodes.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "planners/search/index.h"

namespace floorproof {

// Which of two nodes with equal bounds is settled first.
enum class Ties {
  kLowerNumber,
  kNearerGoal,  // the one with less ahead by the lower bound, then the lower number
  kFirstCome,   // the one that was reached first
};

// A node as the frontier hands it out. `bound`: cost plus the lower bound on what is ahead.
template <class Cost>
struct FrontierNode {
  Cost bound, cost;
  int node;
};

// Any costs: a binary heap.
template <class Cost, Ties kTies = Ties::kLowerNumber>
class HeapFrontier {
 public:
  void Clear() {
    heap_.clear();
    arrivals_ = 0;
  }
  bool empty() const { return heap_.empty(); }
  void Push(const FrontierNode<Cost>& node) {
    heap_.push_back({node, arrivals_++});
    std::push_heap(heap_.begin(), heap_.end(), Later);
  }
  FrontierNode<Cost> Pop() {
    std::pop_heap(heap_.begin(), heap_.end(), Later);
    const FrontierNode<Cost> first = heap_.back();
    heap_.pop_back();
    return first;
  }

 private:
  struct Entry : FrontierNode<Cost> {
    std::uint32_t arrival;
  };
  static bool Later(const Entry& a, const Entry& b) {
    if (a.bound != b.bound) return a.bound > b.bound;
    if constexpr (kTies == Ties::kFirstCome) return a.arrival > b.arrival;
    if constexpr (kTies == Ties::kNearerGoal)
      if (a.cost != b.cost) return a.cost < b.cost;
    return a.node > b.node;
  }

  std::vector<Entry> heap_;
  std::uint32_t arrivals_ = 0;
};

// Small integer costs without a lower bound: a cyclic array of buckets (Dial 1969), of equals the
// first come. kBuckets: more than any edge costs.
template <int kBuckets>
class BucketFrontier {
 public:
  void Clear() {
    for (auto& bucket : buckets_) bucket.clear();
    next_ = 0;
    waiting_ = 0;
    cost_ = 0;
  }
  bool empty() const { return waiting_ == 0; }
  void Push(const FrontierNode<int>& node) {
    buckets_[Z(node.cost % kBuckets)].push_back(node.node);
    ++waiting_;
  }
  FrontierNode<int> Pop() {
    while (next_ == buckets_[Z(cost_ % kBuckets)].size()) {
      buckets_[Z(cost_ % kBuckets)].clear();
      next_ = 0;
      ++cost_;
    }
    --waiting_;
    return {cost_, cost_, buckets_[Z(cost_ % kBuckets)][next_++]};
  }

 private:
  std::array<std::vector<int>, Z(kBuckets)> buckets_;
  std::size_t next_ = 0, waiting_ = 0;  // next_: in the bucket of cost_
  int cost_ = 0;                        // of what was popped last
};

template <class Cost, class Frontier = HeapFrontier<Cost>>
class BestFirstSearch {
 public:
  using Settled = FrontierNode<Cost>;
  static constexpr int kNone = -1;

  explicit BestFirstSearch(std::size_t nodes) : nodes_(nodes) {}

  // Forgets what the last search reached.
  void Begin() {
    if (++search_ == 0) std::fill(nodes_.begin(), nodes_.end(), Node{}), ++search_;
    frontier_.Clear();
    pops_ = 0;
  }

  // A source, if `parent` is none. False: the node was reached for no more before.
  bool Reach(int node, Cost cost, int parent = kNone, Cost ahead = {}) {
    return ReachWith([ahead](int) { return ahead; }, node, cost, parent);
  }
  // What leads on from a node that was reached has changed: it is to be settled once more.
  void Reopen(int node) { frontier_.Push({CostOf(node), CostOf(node), node}); }

  // Settles nodes until there is none left. `ahead(node)`: at most what the way on to the goal
  // costs. `stop(settled)`: whether to end here, without going on from it; the node that it ended
  // at, or kNone. `expand(settled, reach)` calls reach(neighbour, cost) for each neighbour, the
  // cost being that from the sources.
  template <class Ahead, class Stop, class Expand>
  int Run(const Ahead& ahead, const Stop& stop, const Expand& expand) {
    while (!frontier_.empty()) {
      const Settled at = frontier_.Pop();
      ++pops_;
      if (at.cost != nodes_[Z(at.node)].cost) continue;  // overtaken
      if (stop(at)) return at.node;
      expand(at, [&](int node, Cost cost) { ReachWith(ahead, node, cost, at.node); });
    }
    return kNone;
  }
  // Dijkstra's search.
  template <class Stop, class Expand>
  int Run(const Stop& stop, const Expand& expand) {
    return Run([](int) { return Cost{}; }, stop, expand);
  }

  bool IsReached(int node) const { return nodes_[Z(node)].search == search_; }
  Cost CostOf(int node) const { return nodes_[Z(node)].cost; }  // of a node that was reached
  // From a source to the node, both included.
  std::vector<int> PathTo(int node) const {
    std::vector<int> path;
    for (; node != kNone; node = nodes_[Z(node)].parent) path.push_back(node);
    std::reverse(path.begin(), path.end());
    return path;
  }
  // Entries taken from the frontier in this search, overtaken ones too: what it has cost.
  std::int64_t pops() const { return pops_; }

 private:
  struct Node {
    Cost cost{};
    int parent = kNone;
    std::uint32_t search = 0;  // that this is of
  };

  // The lower bound is asked for only where it is needed.
  template <class Ahead>
  bool ReachWith(const Ahead& ahead, int node, Cost cost, int parent) {
    Node& known = nodes_[Z(node)];
    if (known.search == search_ && known.cost <= cost) return false;
    known = {cost, parent, search_};
    frontier_.Push({cost + ahead(node), cost, node});
    return true;
  }

  std::vector<Node> nodes_;
  Frontier frontier_;
  std::uint32_t search_ = 0;
  std::int64_t pops_ = 0;
};

}  // namespace floorproof
