// SPDX-License-Identifier: Apache-2.0
// A lower bound on walks that cover all required cells.
//
// A dead end is entered and left again, so its cells cost two steps each. Only the dead end in
// which a walk without a fixed end may stop is not left. Of the n other cells the first visits are
// joined by n - 1 edges. An edge leads to a neighbour, or costs at least one cell between. How many
// edges can lead to neighbours, a maximum 2-matching says (two_matching.h).
#include <algorithm>

#include "planners/walk/cover_walk.h"
#include "planners/walk/two_matching.h"
#include "planners/walk/walk_graph.h"

namespace floorproof {
namespace {

class Bound {
 public:
  explicit Bound(const CoverWalkProblem& problem)
      : problem_(problem),
        graph_(problem, {}),
        start_(graph_.At(problem.start)),
        end_(problem.end ? graph_.At(*problem.end) : -1),
        open_(graph_.size(), 0),
        required_(graph_.size(), 0) {
    for (int at = 0; at < Count(); ++at) {
      open_[Z(at)] = graph_.region[Z(at)] >= 0;
      required_[Z(at)] =
          open_[Z(at)] && (problem.required(graph_.CellAt(at)) || at == start_ || at == end_);
    }
    TakeOffDeadEnds();
    CountEdges();
  }

  CoverWalkBound result;

 private:
  int Count() const { return static_cast<int>(graph_.size()); }
  double Cost(int at) const { return problem_.cost(graph_.CellAt(at)); }

  void TakeOffDeadEnds() {
    std::vector<int> stack, degree(graph_.size(), 0);
    std::vector<std::pair<int, int>> left;  // outermost first, and the cells they hang on
    for (int at = 0; at < Count(); ++at) {
      if (!open_[Z(at)]) continue;
      for (const int to : graph_.Neighbours(at)) degree[Z(at)] += open_[Z(to)];
      if (degree[Z(at)] == 1) stack.push_back(at);
    }
    while (!stack.empty()) {
      const int at = stack.back();
      stack.pop_back();
      if (degree[Z(at)] != 1 || at == start_ || at == end_) continue;
      open_[Z(at)] = 0;
      for (const int to : graph_.Neighbours(at)) {
        if (!open_[Z(to)]) continue;
        if (--degree[Z(to)] == 1) stack.push_back(to);
        if (!required_[Z(at)]) continue;
        required_[Z(to)] = 1;
        result.steps += 2;
        result.cost += Cost(at) + Cost(to);
        left.push_back({at, to});
      }
    }
    if (end_ >= 0) return;
    std::vector<int> depth(graph_.size(), 0);
    std::vector<double> back(graph_.size(), 0);
    int deepest = 0;
    double dearest = 0;
    for (auto it = left.rbegin(); it != left.rend(); ++it) {
      const auto [at, to] = *it;
      deepest = std::max(deepest, depth[Z(at)] = depth[Z(to)] + 1);
      dearest = std::max(dearest, back[Z(at)] = back[Z(to)] + Cost(to));
    }
    result.steps -= deepest;
    result.cost -= dearest;
  }

  void CountEdges() {
    std::vector<std::int32_t> kind(graph_.size(), 0);
    std::vector<int> degree(graph_.size(), 0);
    double least = 0;
    std::int64_t cells = 0;
    for (int at = 0; at < Count(); ++at) {
      if (!open_[Z(at)]) continue;
      if (least == 0 || Cost(at) < least) least = Cost(at);
      if (!required_[Z(at)]) continue;
      kind[Z(at)] = 1;
      degree[Z(at)] = 2;
      result.cost += Cost(at);
      ++cells;
    }
    if (cells == 1) return;
    const bool closed = start_ == end_;
    const std::int64_t edges = closed ? cells : cells - 1;  // of a walk
    if (closed) {
      result.cost += Cost(start_);
    } else {
      degree[Z(start_)] = 1;
      if (end_ >= 0) degree[Z(end_)] = 1;
    }
    if (cells == 2) {  // there and back over one edge
      result.steps += edges;
      return;
    }
    const auto between =
        std::max<std::int64_t>(0, edges - TwoMatching(kind, graph_.stride, degree).edges());
    result.steps += edges + between;
    result.cost += static_cast<double>(between) * least;
  }

  const CoverWalkProblem& problem_;
  WalkGraph graph_;
  int start_, end_;
  std::vector<std::uint8_t> open_, required_;  // by cell, without dead ends
};

}  // namespace

CoverWalkBound BoundCoverWalk(const CoverWalkProblem& problem) { return Bound(problem).result; }

}  // namespace floorproof
