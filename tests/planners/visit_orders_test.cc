// SPDX-License-Identifier: Apache-2.0
// What all orders of visit keep, and how the sampling paper's methods stand to each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "planners/orders/visit_order.h"
#include "tests/planners/place_tables.h"

namespace floorproof {
namespace {

using testing::MakeOrder;
using testing::PlacesNearWalls;
using testing::PlaceTable;
using testing::ScatteredPlaces;
using testing::Settings;
using testing::WalledGrid;

// Less work where the outcome does not matter.
Settings Quick(std::string_view name) {
  if (name == "aco") return {{"ants", "10"}, {"iterations", "20"}};
  if (name == "pso") return {{"particles", "10"}, {"iterations", "20"}};
  if (name == "tour") return {{"effort", "0.1"}, {"bound_iterations", "100"}};
  return {};
}

void ExpectEachPlaceOnce(const std::vector<int>& order, int places) {
  ASSERT_EQ(order.size(), Z(places));
  if (places > 0) {
    EXPECT_EQ(order.front(), 0);
  }
  std::vector<int> sorted = order;
  std::ranges::sort(sorted);
  for (int i = 0; i < places; ++i) ASSERT_EQ(sorted[Z(i)], i);
}

double SumOf(const PlaceTable& table, const std::vector<int>& order, bool closed) {
  double sum_m = 0;
  for (std::size_t k = 0; k + 1 < order.size(); ++k)
    sum_m += table.distances(order[k], order[k + 1]);
  return closed ? sum_m + table.distances(order.back(), 0) : sum_m;
}

class VisitOrdersTest : public ::testing::TestWithParam<std::string> {};

TEST_P(VisitOrdersTest, VisitsEachPlaceOnceFromTheStartAndKnowsItsLength) {
  const auto dut = MakeOrder(GetParam(), Quick(GetParam()));
  for (const int n : {3, 7, 30, 61})
    for (const bool closed : {false, true}) {
      const PlaceTable table = WalledGrid(Z(n)).Places(n);
      const VisitSequence found = dut->Order(table.Request(closed, 5));
      ExpectEachPlaceOnce(found.order, n);
      EXPECT_NEAR(found.length_m, SumOf(table, found.order, closed), 1e-9 * found.length_m);
      EXPECT_EQ(found.length_m, TourLength(table.distances, found.order, closed));
      if (found.bound_m) {
        EXPECT_LE(*found.bound_m, found.length_m);
      }
    }
}

TEST_P(VisitOrdersTest, FewPlacesAreNoTrouble) {
  const auto dut = MakeOrder(GetParam(), Quick(GetParam()));
  for (const bool closed : {false, true}) {
    EXPECT_TRUE(dut->Order(ScatteredPlaces(0, 1).Request(closed)).order.empty());
    const VisitSequence one = dut->Order(ScatteredPlaces(1, 1).Request(closed));
    EXPECT_EQ(one.order, std::vector<int>{0});
    EXPECT_EQ(one.length_m, 0);
    const PlaceTable pair = ScatteredPlaces(2, 1);
    const VisitSequence two = dut->Order(pair.Request(closed));
    EXPECT_EQ(two.order, (std::vector<int>{0, 1}));
    EXPECT_DOUBLE_EQ(two.length_m, (closed ? 2 : 1) * pair.distances(0, 1));
  }
}

TEST_P(VisitOrdersTest, PlacesUponEachOtherAndEquallyFarAreNoTrouble) {
  const auto dut = MakeOrder(GetParam(), Quick(GetParam()));
  for (const int n : {5, 20})
    for (const bool closed : {false, true}) {
      PlaceTable table = testing::StraightTable(std::vector<Vec2>(Z(n), Vec2(1, 2)));
      const VisitSequence same = dut->Order(table.Request(closed));
      ExpectEachPlaceOnce(same.order, n);
      EXPECT_EQ(same.length_m, 0);
      for (int a = 0; a < n; ++a)
        for (int b = 0; b < a; ++b) table.distances.Set(a, b, 0.5);
      const VisitSequence equal = dut->Order(table.Request(closed));
      ExpectEachPlaceOnce(equal.order, n);
      EXPECT_DOUBLE_EQ(equal.length_m, 0.5 * (closed ? n : n - 1));
      for (int a = 1; a < n; ++a) table.distances.Set(a, a - 1, 0);
      ExpectEachPlaceOnce(dut->Order(table.Request(closed)).order, n);
    }
}

TEST_P(VisitOrdersTest, TheSameSeedGivesTheSameOrderAndOnlyChanceAnother) {
  const PlaceTable table = ScatteredPlaces(40, 3);
  const auto dut = MakeOrder(GetParam(), Quick(GetParam()));
  const VisitSequence a = dut->Order(table.Request(false, 1));
  const VisitSequence b = dut->Order(table.Request(false, 1));
  const VisitSequence c = dut->Order(table.Request(false, 2));
  EXPECT_EQ(a.order, b.order);
  EXPECT_EQ(a.convergence, b.convergence);
  EXPECT_EQ(a.bound_m, b.bound_m);
  const bool is_by_chance =
      GetParam() == "aco" || GetParam() == "pso" || GetParam() == "random_order";
  EXPECT_EQ(a.order != c.order, is_by_chance);
}

TEST_P(VisitOrdersTest, AFloorOfAnotherSizeHasTheSameOrder) {
  const PlaceTable table = PlacesNearWalls(25, 4);
  PlaceTable large = table;
  for (int a = 0; a < 25; ++a)
    for (int b = 0; b < a; ++b) large.distances.Set(a, b, 1024 * table.distances(a, b));
  const auto dut = MakeOrder(GetParam(), Quick(GetParam()));
  const VisitSequence found = dut->Order(table.Request(true, 1));
  const VisitSequence scaled = dut->Order(large.Request(true, 1));
  EXPECT_EQ(found.order, scaled.order);
  EXPECT_DOUBLE_EQ(1024 * found.length_m, scaled.length_m);
}

TEST_P(VisitOrdersTest, ConvergenceNeverRisesAndEndsAtTheLength) {
  const auto dut = MakeOrder(GetParam());
  const bool iterates = GetParam() == "aco" || GetParam() == "pso";
  for (const bool closed : {false, true}) {
    const VisitSequence found = dut->Order(PlacesNearWalls(20, 6).Request(closed, 2));
    ASSERT_EQ(found.convergence.size(), iterates ? 1000u : 0u);
    if (!iterates) continue;
    EXPECT_TRUE(std::ranges::is_sorted(found.convergence, std::greater<>()));
    EXPECT_EQ(found.convergence.back(), found.length_m);
    EXPECT_LT(found.convergence.back(), found.convergence.front());
  }
}

std::vector<std::string> Names() { return PluginNames(VisitOrders()); }

INSTANTIATE_TEST_SUITE_P(All, VisitOrdersTest, ::testing::ValuesIn(Names()),
                         [](const auto& test) { return test.param; });

TEST(VisitOrders, StandToEachOtherAsInTheSamplingPaper) {
  // Table 3: the colony's way is the shortest, the random one the longest.
  for (const int n : {29, 39, 59}) {
    std::map<std::string, double> mean_m;
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      const PlaceTable table = PlacesNearWalls(n, seed);
      for (const std::string name : {"aco", "pso", "zigzag", "random_order", "tour"}) {
        Settings settings;
        if (name == "aco") settings = {{"iterations", "100"}};
        if (name == "pso") settings = {{"iterations", "200"}};
        mean_m[name] += MakeOrder(name, settings)->Order(table.Request(false, seed)).length_m / 5;
      }
    }
    EXPECT_LT(mean_m["aco"], std::min(mean_m["pso"], mean_m["zigzag"])) << n;
    EXPECT_LT(std::max(mean_m["pso"], mean_m["zigzag"]), 0.9 * mean_m["random_order"]) << n;
    EXPECT_LT(mean_m["aco"], 1.15 * mean_m["tour"]) << n;
    EXPECT_GT(mean_m["aco"], mean_m["tour"]) << n;
  }
}

double MeanLength(std::string_view name, const Settings& settings) {
  double sum_m = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed)
    sum_m += MakeOrder(name, settings)->Order(ScatteredPlaces(30, seed).Request(true)).length_m;
  return sum_m / 6;
}

TEST(AntColony, LearnsFromTracesAndGoesBySight) {
  const double both_m = MeanLength("aco", {{"iterations", "100"}});
  EXPECT_LT(1.3 * both_m, MeanLength("aco", {{"iterations", "100"}, {"traces", "0"}}));
  EXPECT_LT(1.1 * both_m, MeanLength("aco", {{"iterations", "100"}, {"sight", "0"}}));
  // Traces that are gone after each iteration teach only the last one's ways.
  EXPECT_LT(both_m, MeanLength("aco", {{"iterations", "100"}, {"evaporation", "1"}}));
}

TEST(AntColony, BySightAloneTheFirstStepIsInProportionToNearness) {
  // One ant, one iteration, no traces: place 1 is three times as near as place 2.
  PlaceTable table = testing::StraightTable({{0, 0}, {1, 0}, {-3, 0}});
  const auto dut = MakeOrder("aco", {{"ants", "1"}, {"iterations", "1"}, {"traces", "0"}});
  int near = 0;
  for (std::uint64_t seed = 0; seed < 4000; ++seed)
    near += dut->Order(table.Request(false, seed)).order[1] == 1;
  EXPECT_NEAR(near / 4000.0, 0.75, 0.03);
}

TEST(ParticleSwarm, IsDrawnToItsOwnAndToTheCommonBest) {
  const double both_m = MeanLength("pso", {{"iterations", "200"}});
  EXPECT_LT(1.1 * both_m,
            MeanLength("pso",
                       {{"iterations", "200"}, {"learning_local", "0"}, {"learning_global", "0"}}));
  EXPECT_LT(1.02 * both_m, MeanLength("pso", {{"iterations", "200"}, {"learning_global", "0"}}));
  EXPECT_LT(1.02 * both_m, MeanLength("pso", {{"iterations", "200"}, {"learning_local", "0"}}));
}

TEST(Zigzag, GoesThroughRowsToAndFroFromTheNearerEnd) {
  // Three rows of three, each skewed by less than `row_m`, numbered by columns; the start is right.
  std::vector<Vec2> places = {{4, 0}};
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) places.push_back({1.0 * column, row + 0.02 * column});
  const PlaceTable table = testing::StraightTable(places);
  const OrderRequest request = table.Request(false);
  EXPECT_EQ(MakeOrder("zigzag")->Order(request).order,
            (std::vector<int>{0, 7, 4, 1, 2, 5, 8, 9, 6, 3}));
  EXPECT_EQ(MakeOrder("zigzag", {{"literal", "true"}})->Order(request).order,
            (std::vector<int>{0, 1, 4, 7, 2, 5, 8, 3, 6, 9}));
  // Rows of no height are single places here: by y alone, too.
  EXPECT_EQ(MakeOrder("zigzag", {{"row_m", "0"}})->Order(request).order,
            (std::vector<int>{0, 1, 4, 7, 2, 5, 8, 3, 6, 9}));
}

TEST(Zigzag, WhichEndIsNearerIsAMatterOfTheWaysNotOfStraightLines) {
  PlaceTable table = testing::StraightTable({{-1, 0}, {0, 1}, {1, 1}, {2, 1}});
  EXPECT_EQ(MakeOrder("zigzag")->Order(table.Request(false)).order, (std::vector<int>{0, 1, 2, 3}));
  table.distances.Set(0, 1, 9);  // round a wall
  EXPECT_EQ(MakeOrder("zigzag")->Order(table.Request(false)).order, (std::vector<int>{0, 3, 2, 1}));
}

TEST(Zigzag, ByTheLetterEqualsGoByAscendingX) {
  const PlaceTable table = testing::StraightTable({{0, 5}, {3, 1}, {2, 1}, {1, 1}, {9, 0}});
  EXPECT_EQ(MakeOrder("zigzag", {{"literal", "true"}})->Order(table.Request(true)).order,
            (std::vector<int>{0, 4, 3, 2, 1}));
}

TEST(RandomOrder, EveryOrderIsAsLikely) {
  const PlaceTable table = ScatteredPlaces(4, 1);
  std::map<std::vector<int>, int> count;
  for (std::uint64_t seed = 0; seed < 6000; ++seed)
    ++count[MakeOrder("random_order")->Order(table.Request(false, seed)).order];
  ASSERT_EQ(count.size(), 6u);
  for (const auto& [order, times] : count) EXPECT_NEAR(times, 1000, 120);  // four deviations
}

}  // namespace
}  // namespace floorproof
