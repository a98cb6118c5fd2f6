// SPDX-License-Identifier: Apache-2.0
// A short open tour through all of a set of places of which only the costs between them are known:
// local search by 3-opt moves, with kicks.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "planners/search/local_search.h"

namespace floorproof {

// Symmetric costs >= 0 between places 0, 1, ... They are integers, so that sums are exact.
class EdgeCosts {
 public:
  static constexpr std::int64_t kUnlimited = std::numeric_limits<std::int64_t>::max();

  virtual ~EdgeCosts() = default;
  // What the edge a - b costs. Where that is not below `limit`, any number that is not may be
  // returned instead.
  virtual std::int64_t Cost(int a, int b, std::int64_t limit = kUnlimited) = 0;
  // A lower bound on Cost(a, b) that is had at once.
  virtual std::int64_t AtLeast(int a, int b) = 0;
  // What it costs to end at a.
  virtual std::int64_t EndCost(int a) const = 0;

  std::int64_t work = 0;  // elementary steps taken to find costs
};

struct CandidateEdge {
  std::int64_t cost = 0;
  int to = 0;
};
using CandidateEdges = CandidateLists<CandidateEdge>;

struct ThreeOptOptions {
  bool fixed_end = false;     // the last place stays the last, as the first one stays the first
  std::int64_t max_work = 0;  // elementary steps: an edge looked at, or eight places turned round
  // At first a kick's outcome is kept with a chance of 1 / e that is worse by this share of the
  // mean edge; the share falls to none as the work is spent. 0: nothing worse is ever kept.
  double heat = 0;
};

// Shortens `tour`, which holds each place once and begins at its first.
void ImproveTour(EdgeCosts& costs, const CandidateEdges& candidates, const ThreeOptOptions& options,
                 std::vector<int>& tour);

}  // namespace floorproof
