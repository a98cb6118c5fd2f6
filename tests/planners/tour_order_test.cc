// SPDX-License-Identifier: Apache-2.0
// The short tour: beside independent searches, beside all other orders, beside its own bound.
#include <gtest/gtest.h>

#include <algorithm>

#include "planners/orders/constructions.h"
#include "planners/orders/exact_order.h"
#include "planners/orders/one_tree_bound.h"
#include "planners/search/three_opt.h"
#include "tests/planners/place_tables.h"

namespace floorproof {
namespace {

using testing::MakeOrder;
using testing::PlacesNearWalls;
using testing::PlaceTable;
using testing::RandomTable;
using testing::ScatteredPlaces;
using testing::WalledGrid;

// By going through all orders.
double Shortest(const PlaceTable& table, bool closed) {
  std::vector<int> order = AsNumbered(table.distances.size());
  double least_m = TourLength(table.distances, order, closed);
  while (std::next_permutation(order.begin() + 1, order.end()))
    least_m = std::min(least_m, TourLength(table.distances, order, closed));
  return least_m;
}

std::vector<PlaceTable> Tables(int n, std::uint64_t seeds) {
  std::vector<PlaceTable> tables;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    tables.push_back(ScatteredPlaces(n, seed));
    tables.push_back(PlacesNearWalls(n, seed));
    tables.push_back(RandomTable(n, seed));
    tables.push_back(WalledGrid(seed).Places(n));
  }
  return tables;
}

TEST(ExactOrder, NoOrderOfEightPlacesIsShorter) {
  for (const int n : {2, 3, 5, 8})
    for (const PlaceTable& table : Tables(n, 3))
      for (const bool closed : {false, true}) {
        const std::vector<int> dut = ExactOrder(table.distances, closed);
        EXPECT_EQ(dut.front(), 0);
        EXPECT_NEAR(TourLength(table.distances, dut, closed), Shortest(table, closed), 1e-9);
      }
}

TEST(OneTreeBound, NoOrderOfEightPlacesIsShorter) {
  double share = 0;
  int count = 0;
  for (const int n : {2, 3, 5, 8})
    for (const PlaceTable& table : Tables(n, 4))
      for (const bool closed : {false, true}) {
        const double least_m = Shortest(table, closed);
        // Whatever length is said to be known.
        for (const double known_m : {least_m, 3 * least_m, 0.5 * least_m})
          EXPECT_LE(OneTreeBound(table.distances, closed, known_m, 300), least_m);
        share += OneTreeBound(table.distances, closed, least_m, 300) / least_m;
        ++count;
      }
  EXPECT_GT(share / count, 0.98);
}

TEST(OneTreeBound, IsTightWhereTheShortestWayIsATree) {
  // On a line the spanning tree is the way; back again, it is twice as long.
  std::vector<Vec2> line;
  for (int i = 0; i < 30; ++i) line.push_back({0.5 * i, 0});
  const PlaceTable table = testing::StraightTable(line);
  EXPECT_NEAR(OneTreeBound(table.distances, false, 20, 500), 14.5, 1e-6);
  EXPECT_LE(OneTreeBound(table.distances, false, 20, 500), 14.5);
  EXPECT_NEAR(OneTreeBound(table.distances, true, 40, 2000), 29, 0.3);
}

TEST(OneTreeBound, MoreTreesNeverLowerIt) {
  const PlaceTable table = WalledGrid(3).Places(60);
  double before_m = 0;
  for (const int iterations : {1, 10, 100, 1000}) {
    const double bound_m = OneTreeBound(table.distances, false, 100, iterations);
    EXPECT_GE(bound_m, before_m);
    before_m = bound_m;
  }
}

TEST(Constructions, GreedyAndNearestNeighbourVisitEachPlaceOnce) {
  for (const int n : {0, 1, 2, 3, 10, 80})
    for (const PlaceTable& table : Tables(n, 2))
      for (std::vector<int> dut :
           {GreedyOrder(table.distances), NearestNeighbourOrder(table.distances)}) {
        if (n > 0) {
          EXPECT_EQ(dut.front(), 0);
        }
        std::ranges::sort(dut);
        EXPECT_EQ(dut, AsNumbered(n));
      }
}

TEST(Constructions, AlongALineTheyGoStraightOn) {
  const PlaceTable table = testing::StraightTable({{0, 0}, {3, 0}, {1, 0}, {4.5, 0}, {2, 0}});
  EXPECT_EQ(GreedyOrder(table.distances), (std::vector<int>{0, 2, 4, 1, 3}));
  EXPECT_EQ(NearestNeighbourOrder(table.distances), (std::vector<int>{0, 2, 4, 1, 3}));
}

TEST(TourOrder, UpToADozenPlacesAreSolvedAndSaidToBe) {
  for (const PlaceTable& table : Tables(8, 2))
    for (const bool closed : {false, true}) {
      const VisitSequence dut = MakeOrder("tour")->Order(table.Request(closed));
      EXPECT_NEAR(dut.length_m, Shortest(table, closed), 1e-9);
      EXPECT_NEAR(*dut.bound_m, dut.length_m, 1e-9);
      EXPECT_LE(*dut.bound_m, dut.length_m);
    }
}

// The local search where the exact one could answer: the first dozen of its places, and one more
// that lies upon the start and so changes nothing.
TEST(TourOrder, ItsLocalSearchFindsTheShortestOfADozen) {
  for (const PlaceTable& table : Tables(kMaxExactPlaces, 3)) {
    PlaceTable more{table.places, PlaceDistances(kMaxExactPlaces + 1)};
    more.places.push_back(table.places.front());
    for (int a = 0; a < kMaxExactPlaces; ++a)
      for (int b = 0; b < a; ++b) more.distances.Set(a, b, table.distances(a, b));
    for (int a = 1; a < kMaxExactPlaces; ++a)
      more.distances.Set(a, kMaxExactPlaces, table.distances(0, a));
    for (const bool closed : {false, true}) {
      const double exact_m =
          TourLength(table.distances, ExactOrder(table.distances, closed), closed);
      const VisitSequence dut = MakeOrder("tour")->Order(more.Request(closed));
      // A table that breaks the triangle inequality may profit from passing the start again.
      EXPECT_LE(dut.length_m, exact_m + 1e-9);
      EXPECT_LE(*dut.bound_m, dut.length_m);
      EXPECT_LE(*dut.bound_m, exact_m);
    }
  }
}

TEST(TourOrder, TheTourIsNeverLongerThanAnyOtherOrder) {
  for (const int n : {10, 35, 59})
    for (const PlaceTable& table : Tables(n, n > 50 ? 1 : 2))
      for (const bool closed : {false, true}) {
        const VisitSequence dut =
            MakeOrder("tour", {{"effort", "0.3"}})->Order(table.Request(closed));
        ASSERT_TRUE(dut.bound_m);
        for (const auto& entry : VisitOrders()) {
          testing::Settings settings;
          if (entry.name == "aco") settings = {{"iterations", "40"}};
          if (entry.name == "pso") settings = {{"iterations", "80"}};
          const double other_m =
              MakeOrder(entry.name, settings)->Order(table.Request(closed)).length_m;
          EXPECT_LE(dut.length_m, other_m * (1 + 1e-12)) << entry.name << " of " << n;
          EXPECT_LT(*dut.bound_m, other_m) << entry.name << " of " << n;
        }
      }
}

// Rows of a lattice leave nothing to be saved: each step is as short as any.
TEST(TourOrder, OnALatticeEveryStepIsTheShortest) {
  std::vector<Vec2> places;
  for (int y = 0; y < 14; ++y)
    for (int x = 0; x < 15; ++x) places.push_back({0.5 * x, 0.5 * y});
  const PlaceTable table = testing::StraightTable(places);
  const VisitSequence open = MakeOrder("tour", {{"effort", "0.3"}})->Order(table.Request(false));
  EXPECT_NEAR(open.length_m, 0.5 * 209, 1e-9);
  EXPECT_NEAR(*open.bound_m, open.length_m, 1e-3 * open.length_m);
  const VisitSequence closed = MakeOrder("tour", {{"effort", "0.3"}})->Order(table.Request(true));
  EXPECT_NEAR(closed.length_m, 0.5 * 210, 1e-9);
}

TEST(TourOrder, OfAHundredPlacesIsNearItsBound) {
  for (const bool closed : {false, true}) {
    double ratio = 0;
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      const VisitSequence dut =
          MakeOrder("tour", {{"effort", "0.3"}})->Order(ScatteredPlaces(100, seed).Request(closed));
      EXPECT_LT(dut.length_m, 1.03 * *dut.bound_m);
      ratio += dut.length_m / *dut.bound_m / 4;
    }
    EXPECT_LT(ratio, 1.015);
  }
}

TEST(TourOrder, MoreEffortIsWellSpent) {
  double little_m = 0, much_m = 0;
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const PlaceTable table = ScatteredPlaces(150, seed);
    little_m += MakeOrder("tour", {{"effort", "0.003"}})->Order(table.Request(true)).length_m;
    much_m += MakeOrder("tour")->Order(table.Request(true)).length_m;
  }
  EXPECT_LT(much_m, 0.995 * little_m);
}

TEST(TourOrder, TheWayBackIsWorthPlanningFor) {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const PlaceTable table = WalledGrid(seed).Places(50);
    const VisitSequence open = MakeOrder("tour")->Order(table.Request(false));
    const VisitSequence closed = MakeOrder("tour")->Order(table.Request(true));
    EXPECT_LT(open.length_m, closed.length_m);
    EXPECT_LE(closed.length_m, TourLength(table.distances, open.order, true) + 1e-9);
    EXPECT_LE(open.length_m, TourLength(table.distances, closed.order, false) + 1e-9);
  }
}

TEST(TourOrder, WithoutTreesThereIsNoBound) {
  const PlaceTable table = ScatteredPlaces(20, 1);
  EXPECT_FALSE(MakeOrder("tour", {{"bound_iterations", "0"}})->Order(table.Request(false)).bound_m);
}

}  // namespace
}  // namespace floorproof
