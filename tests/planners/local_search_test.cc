// SPDX-License-Identifier: Apache-2.0
#include "planners/search/local_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/streams.h"
#include "env/geometry/geometry.h"
#include "planners/search/array_tour.h"
#include "planners/search/three_opt.h"

namespace floorproof {
namespace {

TEST(LookQueue, EachVertexWaitsOnceFirstComeFirstServed) {
  LookQueue dut(5);
  for (const int v : {3, 1, 3, 4}) dut.Push(v);
  EXPECT_EQ(dut.Pop(), 3);
  dut.Push(3);  // it waits no more, so it may come again
  dut.Push(1);
  std::vector<int> rest;
  while (!dut.empty()) rest.push_back(dut.Pop());
  EXPECT_EQ(rest, (std::vector<int>{1, 4, 3}));
}

TEST(CandidateLists, KeepWhatWasAddedToEachVertex) {
  CandidateLists<int> dut;
  dut.Add(7), dut.Add(8);
  EXPECT_EQ(dut.Open().size(), 2u);
  dut.Close();
  dut.Close();
  dut.Add(9);
  dut.Close();
  EXPECT_EQ(dut.Of(0).size(), 2u);
  EXPECT_TRUE(dut.Of(1).empty());
  EXPECT_EQ(dut.Of(2)[0], 9);
}

TEST(Settle, GoesOnUntilNothingHelps) {
  // Each vertex can be helped as often as its number, and then asks for the next lower one.
  LookQueue queue(4);
  std::vector<int> left = {0, 1, 2, 3};
  queue.Push(3);
  Settle(queue, [&](int v) {
    if (left[Z(v)] == 0) return false;
    --left[Z(v)];
    queue.Push(v - 1);
    return true;
  });
  EXPECT_EQ(left, (std::vector<int>{0, 0, 0, 0}));
}

// A tour of one number: kicks move it, and only what is less is kept.
struct Number {
  int value = 100, before = 0, kicks = 0;
  Stream random{1, 0, "number"};
  bool MayKick() { return kicks++ < 500; }
  bool Kick() {
    before = value;
    value += static_cast<int>(random.Below(21)) - 10;
    return value != before;
  }
  void Settle() {}
  bool IsWorse() const { return value > before || value < 0; }
  void Undo() { value = before; }
};

TEST(Perturb, KeepsWhatIsNoWorse) {
  Number dut;
  Perturb(dut);
  EXPECT_EQ(dut.value, 0);
}

std::vector<int> Around(const ArrayTour& tour, int from) {
  std::vector<int> order = {from};
  for (int v = tour.Next(from); v != from; v = tour.Next(v)) order.push_back(v);
  return order;
}

TEST(ArrayTour, AFlipTurnsThePartRound) {
  ArrayTour dut({0, 1, 2, 3, 4, 5, 6, 7});
  dut.Flip(2, 4);
  EXPECT_EQ(Around(dut, 0), (std::vector<int>{0, 1, 4, 3, 2, 5, 6, 7}));
  dut.Flip(1, 6);  // longer than the rest, which is turned instead
  EXPECT_EQ(Around(dut, 0), (std::vector<int>{0, 6, 5, 2, 3, 4, 1, 7}));
  EXPECT_EQ(dut.Length(6, 3), 4);
  EXPECT_EQ(dut.Ahead(6, 2), 2);
  EXPECT_EQ(dut.Ahead(6, -2), 7);
  EXPECT_EQ(dut.Prev(6), 0);
}

TEST(ArrayTour, FlipsAreUndoneWhicheverWayOneLooks) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Stream random(seed, 0, "flips");
    std::vector<int> order(11);
    std::iota(order.begin(), order.end(), 0);
    ArrayTour dut(order);
    for (int k = 0; k < 12; ++k) {
      if (random.Below(3) == 0) dut.Mirror();
      const int a = static_cast<int>(random.Below(11));
      dut.Flip(a, dut.Ahead(a, static_cast<int>(random.Below(10))));
    }
    EXPECT_EQ(dut.flips(), 12u);
    dut.UndoTo(0);
    if (dut.mirrored()) dut.Mirror();
    ASSERT_EQ(Around(dut, 0), order) << seed;
  }
}

// Places in the plane.
class PlaneCosts : public EdgeCosts {
 public:
  explicit PlaneCosts(int n, std::uint64_t seed) {
    Stream random(seed, 0, "plane");
    for (int i = 0; i < n; ++i)
      places_.push_back({random.Uniform(0, 1000), random.Uniform(0, 1000)});
  }
  std::int64_t Cost(int a, int b, std::int64_t) override {
    return std::llround((places_[Z(a)] - places_[Z(b)]).norm());
  }
  std::int64_t AtLeast(int a, int b) override { return Cost(a, b, 0); }
  std::int64_t EndCost(int) const override { return 0; }
  CandidateEdges Candidates(std::size_t count) {
    CandidateEdges all;
    const int n = static_cast<int>(places_.size());
    for (int a = 0; a < n; ++a) {
      std::vector<CandidateEdge> edges;
      for (int b = 0; b < n; ++b)
        if (b != a) edges.push_back({Cost(a, b, 0), b});
      std::ranges::stable_sort(edges, {}, &CandidateEdge::cost);
      for (std::size_t k = 0; k < std::min(count, edges.size()); ++k) all.Add(edges[k]);
      all.Close();
    }
    return all;
  }
  std::int64_t Length(const std::vector<int>& tour) {
    std::int64_t sum = 0;
    for (std::size_t k = 1; k < tour.size(); ++k) sum += Cost(tour[k - 1], tour[k], 0);
    return sum;
  }

 private:
  std::vector<Vec2> places_;
};

std::vector<int> AsNumbered(int n) {
  std::vector<int> tour(Z(n));
  std::iota(tour.begin(), tour.end(), 0);
  return tour;
}

TEST(ThreeOpt, OfSevenPlacesNoOrderIsShorter) {
  for (std::uint64_t seed = 0; seed < 30; ++seed)
    for (const bool fixed_end : {false, true}) {
      PlaneCosts costs(7, seed);
      std::vector<int> dut = AsNumbered(7), order = dut;
      ImproveTour(costs, costs.Candidates(6), {fixed_end, 100'000}, dut);
      EXPECT_EQ(dut.front(), 0);
      if (fixed_end) {
        EXPECT_EQ(dut.back(), 6);
      }
      std::int64_t least = costs.Length(order);
      while (std::next_permutation(order.begin() + 1, order.end() - fixed_end))
        least = std::min(least, costs.Length(order));
      EXPECT_EQ(costs.Length(dut), least) << seed;
    }
}

TEST(ThreeOpt, ManyPlacesMakeATourAsLongAsRandomPointsDo) {
  PlaneCosts costs(400, 1);
  std::vector<int> dut = AsNumbered(400);
  ImproveTour(costs, costs.Candidates(8), {false, 20'000'000}, dut);
  // Beardwood, Halton & Hammersley 1959: 0.7124 sqrt(n A), and some more at the square's edge.
  EXPECT_LT(static_cast<double>(costs.Length(dut)), 1.05 * 0.7124 * std::sqrt(400.0) * 1000);
  std::ranges::sort(dut);
  EXPECT_EQ(dut, AsNumbered(400)) << "each place once";
}

TEST(ThreeOpt, WithoutWorkItLeavesTheTour) {
  PlaneCosts costs(30, 2);
  std::vector<int> dut = AsNumbered(30);
  ImproveTour(costs, costs.Candidates(5), {false, 0}, dut);
  EXPECT_EQ(dut, AsNumbered(30));
}

}  // namespace
}  // namespace floorproof
