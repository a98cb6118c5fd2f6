// SPDX-License-Identifier: Apache-2.0
// Dead ends are gone into and come out of, but for the one in which a walk without a fixed end may
// stay. Of the n other cells the first visits make n - 1 links, each to a neighbour or at the price
// of a cell between; how many can be to neighbours says a greatest 2-matching.
#include <algorithm>

#include "planners/lines/index.h"
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
        wanted_(graph_.size(), 0) {
    for (int at = 0; at < Count(); ++at) {
      open_[Z(at)] = graph_.region[Z(at)] >= 0;
      wanted_[Z(at)] =
          open_[Z(at)] && (problem.wanted(graph_.CellAt(at)) || at == start_ || at == end_);
    }
    LeaveDeadEnds();
    CountLinks();
  }

  CoverWalkBound result;

 private:
  int Count() const { return static_cast<int>(graph_.size()); }
  double Cost(int at) const { return problem_.cost(graph_.CellAt(at)); }

  void LeaveDeadEnds() {
    std::vector<int> stack, ways(graph_.size(), 0);
    std::vector<std::pair<int, int>> left;  // outermost first, and the cells they hang on
    for (int at = 0; at < Count(); ++at) {
      if (!open_[Z(at)]) continue;
      for (const int to : graph_.Beside(at)) ways[Z(at)] += open_[Z(to)];
      if (ways[Z(at)] == 1) stack.push_back(at);
    }
    while (!stack.empty()) {
      const int at = stack.back();
      stack.pop_back();
      if (ways[Z(at)] != 1 || at == start_ || at == end_) continue;
      open_[Z(at)] = 0;
      for (const int to : graph_.Beside(at)) {
        if (!open_[Z(to)]) continue;
        if (--ways[Z(to)] == 1) stack.push_back(to);
        if (!wanted_[Z(at)]) continue;
        wanted_[Z(to)] = 1;
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

  void CountLinks() {
    std::vector<std::int32_t> kind(graph_.size(), 0);
    std::vector<int> most(graph_.size(), 0);
    double least = 0;
    std::int64_t cells = 0;
    for (int at = 0; at < Count(); ++at) {
      if (!open_[Z(at)]) continue;
      if (least == 0 || Cost(at) < least) least = Cost(at);
      if (!wanted_[Z(at)]) continue;
      kind[Z(at)] = 1;
      most[Z(at)] = 2;
      result.cost += Cost(at);
      ++cells;
    }
    if (cells == 1) return;
    const bool closed = start_ == end_;
    const std::int64_t links = closed ? cells : cells - 1;  // of a walk
    if (closed) {
      result.cost += Cost(start_);
    } else {
      most[Z(start_)] = 1;
      if (end_ >= 0) most[Z(end_)] = 1;
    }
    if (cells == 2) {  // there and back over one link
      result.steps += links;
      return;
    }
    const auto between =
        std::max<std::int64_t>(0, links - TwoMatching(kind, graph_.stride, most).links());
    result.steps += links + between;
    result.cost += static_cast<double>(between) * least;
  }

  const CoverWalkProblem& problem_;
  WalkGraph graph_;
  int start_, end_;
  std::vector<std::uint8_t> open_, wanted_;  // by cell, without dead ends
};

}  // namespace

CoverWalkBound BoundCoverWalk(const CoverWalkProblem& problem) { return Bound(problem).result; }

}  // namespace floorproof
