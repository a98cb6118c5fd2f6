// SPDX-License-Identifier: Apache-2.0
#include "planners/search/best_first.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>

#include "base/streams.h"
#include "planners/search/neighbours.h"

namespace floorproof {
namespace {

// Nodes of a graph with edges drawn at random, costs 1 to 9.
struct RandomGraph {
  struct Edge {
    int to, cost;
  };
  std::vector<std::vector<Edge>> edges;

  RandomGraph(int nodes, std::uint64_t seed) : edges(Z(nodes)) {
    Stream random(seed, 0, "graph");
    for (auto& out : edges)
      for (int k = 0; k < 3; ++k)
        out.push_back({static_cast<int>(random.Below(static_cast<std::uint64_t>(nodes))),
                       1 + static_cast<int>(random.Below(9))});
  }
  int size() const { return static_cast<int>(edges.size()); }
  // Bellman & Ford's: edges are relaxed until none shortens anything.
  std::vector<int> Distances(int from) const {
    std::vector<int> d(edges.size(), kFar);
    d[Z(from)] = 0;
    for (bool changed = true; changed;) {
      changed = false;
      for (int a = 0; a < size(); ++a)
        for (const auto& [b, cost] : edges[Z(a)])
          if (d[Z(a)] + cost < d[Z(b)]) d[Z(b)] = d[Z(a)] + cost, changed = true;
    }
    return d;
  }
  static constexpr int kFar = 1'000'000;
};

template <class Search>
void SpreadFrom(const RandomGraph& graph, int from, Search& dut) {
  dut.Begin();
  dut.Reach(from, 0);
  dut.Run([](const auto&) { return false; },
          [&](const auto& at, const auto& reach) {
            for (const auto& [to, cost] : graph.edges[Z(at.node)]) reach(to, at.cost + cost);
          });
}

template <class Search>
class AnyFrontier : public ::testing::Test {};
using Searches = ::testing::Types<BestFirstSearch<int>,
                                  BestFirstSearch<int, HeapFrontier<int, Ties::kFirstCome>>,
                                  BestFirstSearch<int, HeapFrontier<int, Ties::kNearerGoal>>,
                                  BestFirstSearch<int, BucketFrontier<10>>>;
TYPED_TEST_SUITE(AnyFrontier, Searches);

TYPED_TEST(AnyFrontier, FindsTheDistancesThatRelaxingAllEdgesFinds) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const RandomGraph graph(60, seed);
    TypeParam dut(60);
    for (const int from : {0, 17}) {  // its memory is used again
      SpreadFrom(graph, from, dut);
      const std::vector<int> expected = graph.Distances(from);
      for (int node = 0; node < graph.size(); ++node) {
        ASSERT_EQ(dut.IsReached(node), expected[Z(node)] < RandomGraph::kFar);
        if (!dut.IsReached(node)) continue;
        ASSERT_EQ(dut.CostOf(node), expected[Z(node)]);
        const std::vector<int> path = dut.PathTo(node);
        ASSERT_EQ(path.front(), from);
        ASSERT_EQ(path.back(), node);
      }
    }
  }
}

TYPED_TEST(AnyFrontier, SettlesNodesInTheOrderOfTheirCosts) {
  const RandomGraph graph(60, 5);
  TypeParam dut(60);
  dut.Begin();
  dut.Reach(0, 0);
  int last = 0;
  dut.Run(
      [&](const auto& at) {
        EXPECT_GE(at.cost, last);
        last = at.cost;
        return false;
      },
      [&](const auto& at, const auto& reach) {
        for (const auto& [to, cost] : graph.edges[Z(at.node)]) reach(to, at.cost + cost);
      });
}

// 20 x 20 open cells, from the lower left to the upper right.
template <class Search>
std::vector<int> AcrossTheFloor(Search& dut, bool with_bound) {
  constexpr int kSide = 20;
  const Grid<std::uint8_t> floor(kSide, kSide);
  const Cell goal{kSide - 1, kSide - 1};
  const auto ahead = [&](int node) {
    const Cell c = CellAt(floor, Z(node));
    return with_bound ? std::abs(c.ix - goal.ix) + std::abs(c.iy - goal.iy) : 0;
  };
  dut.Begin();
  dut.Reach(0, 0, Search::kNone, ahead(0));
  const int end = dut.Run(
      ahead, [&](const auto& at) { return at.node == NumberOf(floor, goal); },
      [&](const auto& at, const auto& reach) {
        for (const Cell step : kSideSteps)
          if (const Cell next = CellAt(floor, Z(at.node)) + step; floor.Inside(next))
            reach(NumberOf(floor, next), at.cost + 1);
      });
  return dut.PathTo(end);
}

TEST(BestFirstSearch, ALowerBoundSavesWorkAndKeepsTheLength) {
  BestFirstSearch<int, HeapFrontier<int, Ties::kNearerGoal>> dut(400);
  const auto blind = AcrossTheFloor(dut, false).size();
  const auto blind_pops = dut.pops();
  EXPECT_EQ(AcrossTheFloor(dut, true).size(), blind);
  EXPECT_EQ(blind, 39u);
  EXPECT_LT(dut.pops(), blind_pops / 8) << "of equals the one nearer to the goal comes first";
}

TEST(BestFirstSearch, TiesAreBrokenByTheRule) {
  // Node 3 is reached before node 2, both for 1.
  const auto first_settled = [](auto dut) {
    dut.Begin();
    dut.Reach(3, 1);
    dut.Reach(2, 1);
    return dut.Run([](const auto&) { return true; }, [](const auto&, const auto&) {});
  };
  EXPECT_EQ(first_settled(BestFirstSearch<int>(4)), 2);
  EXPECT_EQ(first_settled(BestFirstSearch<int, HeapFrontier<int, Ties::kFirstCome>>(4)), 3);
  EXPECT_EQ(first_settled(BestFirstSearch<int, BucketFrontier<4>>(4)), 3);
}

TEST(BestFirstSearch, ABoundThatIsNotConsistentStillGivesTheCheapestPath) {
  // 0 -> 1 -> 2 costs 2, 0 -> 2 costs 3; 2 -> 3 costs 5. The bound hides node 1 for long.
  const std::vector<std::vector<std::pair<int, int>>> edges = {
      {{1, 1}, {2, 3}}, {{2, 1}}, {{3, 5}}};
  const std::vector<int> bound = {0, 6, 0, 0};
  BestFirstSearch<int> dut(4);
  dut.Begin();
  dut.Reach(0, 0);
  const int end =
      dut.Run([&](int node) { return bound[Z(node)]; }, [](const auto& at) { return at.node == 3; },
              [&](const auto& at, const auto& reach) {
                for (const auto& [to, cost] : edges[Z(at.node)]) reach(to, at.cost + cost);
              });
  EXPECT_EQ(dut.CostOf(end), 7);
  EXPECT_EQ(dut.PathTo(end), (std::vector<int>{0, 1, 2, 3}));
}

TEST(BestFirstSearch, WithoutAGoalInReachThereIsNoPath) {
  BestFirstSearch<double> dut(3);
  dut.Begin();
  dut.Reach(0, 0);
  const int end = dut.Run([](const auto& at) { return at.node == 2; },
                          [](const auto& at, const auto& reach) { reach(1, at.cost + 1); });
  EXPECT_EQ(end, dut.kNone);
  EXPECT_TRUE(dut.PathTo(end).empty());
  EXPECT_FALSE(dut.IsReached(2));
}

}  // namespace
}  // namespace floorproof
