// SPDX-License-Identifier: Apache-2.0
// What it costs to go from one place of a covering walk to another.
#pragma once

#include <vector>

#include "planners/search/best_first.h"
#include "planners/search/three_opt.h"
#include "planners/walk/region_borders.h"
#include "planners/walk/walk_graph.h"

namespace floorproof {

// Places are cells (the last one may be the first once more). An edge costs what lies between its
// two cells on the cheapest way: neighbours cost nothing, unless one of them is terrain.
class WalkCosts : public EdgeCosts {
 public:
  WalkCosts(const WalkGraph& graph, const std::vector<int>& places);

  std::int64_t Cost(int a, int b, std::int64_t limit = kUnlimited) override;
  std::int64_t AtLeast(int a, int b) override;
  std::int64_t EndCost(int a) const override;

  // About `count` edges a place.
  CandidateEdges Candidates(std::size_t count);
  // Adds the cells behind a's up to b's.
  void AppendWay(int a, int b, std::vector<int>& cells);

 private:
  void MeasureToEdge();
  const std::uint16_t* BordersTo(int to, int from);
  std::int64_t Ahead(int from, int to, const std::uint16_t* borders) const;
  std::int64_t Search(int from, int to, std::int64_t limit);
  // Calls visit(place or -1, cost) for cells in the order of their cost, until it returns false.
  template <class Visit>
  void Spread(int from, const Visit& visit);
  void FillRow(int a);

  const WalkGraph& graph_;
  const std::vector<int>& places_;
  int n_;
  std::vector<int> place_at_;  // by cell; -1: none
  BestFirstSearch<std::int64_t, HeapFrontier<std::int64_t, Ties::kNearerGoal>> search_;

  std::vector<std::int64_t> to_edge_;  // by cell
  RegionBorders borders_;

  std::vector<std::int64_t> table_;  // few places: all pairs, row by row when asked for
  std::vector<std::uint8_t> filled_;
  struct Pair {
    std::uint64_t ab = ~std::uint64_t{0};
    std::int64_t cost = 0;
    bool exact = false;  // else the cost is not below this
  };
  std::vector<Pair> pairs_;  // many places: those asked for last
};

}  // namespace floorproof
