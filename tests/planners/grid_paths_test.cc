// SPDX-License-Identifier: Apache-2.0
#include "planners/search/grid_paths.h"

#include <gtest/gtest.h>

#include <limits>

#include "base/streams.h"
#include "tests/planners/risk_floors.h"

namespace floorproof {
namespace {

using testing::ExpectWay;
using testing::OpenCells;

constexpr double kNone = std::numeric_limits<double>::infinity();

Grid<std::uint8_t> RandomCells(Stream& random, int width, int height, double closed) {
  Grid<std::uint8_t> open(width, height);
  for (std::uint8_t& cell : open.cells) cell = random.Uniform() >= closed;
  return open;
}

Cell RandomOpen(Stream& random, const Grid<std::uint8_t>& open) {
  for (;;) {
    const Cell cell = CellAt(open, random.Below(open.cells.size()));
    if (open(cell)) return cell;
  }
}

// Least sums of `cost` over ways from `from`, both ends included: Bellman & Ford, until nothing
// changes.
Grid<double> LeastSums(const Grid<std::uint8_t>& open, const std::vector<Cell>& from,
                       const std::function<double(Cell)>& cost) {
  Grid<double> sum(open.width, open.height, kNone);
  for (const Cell cell : from) sum(cell) = cost(cell);
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < open.cells.size(); ++i) {
      const Cell cell = CellAt(open, i);
      if (!open(cell)) continue;
      for (const Cell step : kSideSteps)
        if (open.Inside(cell + step) && open(cell + step) &&
            sum(cell + step) + cost(cell) < sum(cell)) {
          sum(cell) = sum(cell + step) + cost(cell);
          changed = true;
        }
    }
  }
  return sum;
}

TEST(GridPaths, StepsAreThoseOfTheShortestWay) {
  const Grid<std::uint8_t> open = OpenCells(R"(
      ..#..
      .##.#
      .....
      ####.)");
  EXPECT_EQ(StepsFrom(open, {0, 3}).cells,  // from the upper left, the lowest row first
            (std::vector<std::int32_t>{-1, -1, -1, -1, 7,   //
                                       2,  3,  4,  5,  6,   //
                                       1,  -1, -1, 6,  -1,  //
                                       0,  1,  -1, 7,  8}));
  for (const std::int32_t steps : StepsFrom(open, {2, 3}).cells) EXPECT_EQ(steps, -1) << "closed";
  for (const std::int32_t steps : StepsFrom(open, {9, 9}).cells) EXPECT_EQ(steps, -1) << "outside";
}

TEST(GridPaths, ShortestIsAsShortAsTheStepsSay) {
  Stream random(1, 0, "shortest");
  for (int round = 0; round < 30; ++round) {
    const Grid<std::uint8_t> open = RandomCells(random, 17, 12, 0.35);
    GridPaths dut(open);  // one for many searches: its memory is reused
    for (int i = 0; i < 20; ++i) {
      const Cell a = RandomOpen(random, open), b = RandomOpen(random, open);
      const std::vector<Cell> way = dut.Shortest(a, b);
      const int steps = StepsFrom(open, a)(b);
      ASSERT_EQ(static_cast<int>(way.size()), steps + 1);
      if (steps < 0) continue;
      ExpectWay(open, way);
      ASSERT_EQ(way.front(), a);
      ASSERT_EQ(way.back(), b);
    }
  }
  const Grid<std::uint8_t> open = OpenCells("..#.\n");
  GridPaths dut(open);
  EXPECT_TRUE(dut.Shortest({0, 0}, {2, 0}).empty());
  EXPECT_TRUE(dut.Shortest({0, 0}, {3, 0}).empty());
  EXPECT_TRUE(dut.Shortest({0, 0}, {4, 0}).empty());
  EXPECT_TRUE(dut.Shortest({-1, 0}, {0, 0}).empty());
  EXPECT_EQ(dut.Shortest({1, 0}, {1, 0}), (std::vector<Cell>{{1, 0}}));
}

TEST(GridPaths, TheRingComesBeforeTheWay) {
  // Algorithm 3: the cell behind the wall is two rings away and six steps, `far` three and three.
  const Grid<std::uint8_t> open = OpenCells(R"(
      ....#..
      ....#..
      ....#..
      .......)");
  GridPaths dut(open);
  const Cell from{3, 2}, behind{5, 2}, far{0, 2}, near{1, 2};
  const auto way = dut.ToNearestRing(from, [&](Cell c) { return c == behind || c == far; });
  ASSERT_EQ(way.size(), 7u);
  EXPECT_EQ(way.back(), behind);
  // On one ring the shorter way wins.
  EXPECT_EQ(dut.ToNearestRing(from, [&](Cell c) { return c == behind || c == near; }),
            (std::vector<Cell>{{3, 2}, {2, 2}, {1, 2}}));
}

TEST(GridPaths, ToNearestRingIsTheLeastOfTheNearestRingThatCanBeReached) {
  Stream random(2, 0, "rings");
  int found = 0, none = 0;
  for (int round = 0; round < 60; ++round) {
    const Grid<std::uint8_t> open = RandomCells(random, 15, 11, 0.4);
    GridPaths dut(open);
    for (int i = 0; i < 10; ++i) {
      const Cell from = RandomOpen(random, open);
      Grid<std::uint8_t> wanted(15, 11);
      for (int k = 0; k < 4; ++k) wanted(RandomOpen(random, open)) = 1;
      wanted(from) = 0;
      const Grid<std::int32_t> steps = StepsFrom(open, from);
      int nearest = 99, least = 0;
      for (std::size_t c = 0; c < open.cells.size(); ++c) {
        if (!wanted.cells[c] || steps.cells[c] < 0) continue;
        const Cell cell = CellAt(open, c);
        const int ring = std::max(std::abs(cell.ix - from.ix), std::abs(cell.iy - from.iy));
        if (ring < nearest || (ring == nearest && steps(cell) < least))
          nearest = ring, least = steps(cell);
      }
      const auto way =
          dut.ToNearestRing(from, [&](Cell c) { return wanted.Inside(c) && wanted(c); });
      if (nearest == 99) {
        ++none;
        ASSERT_TRUE(way.empty());
        continue;
      }
      ++found;
      ASSERT_EQ(static_cast<int>(way.size()), least + 1);
      ExpectWay(open, way);
      ASSERT_EQ(way.front(), from);
      ASSERT_TRUE(wanted(way.back()));
      ASSERT_EQ(std::max(std::abs(way.back().ix - from.ix), std::abs(way.back().iy - from.iy)),
                nearest);
    }
  }
  EXPECT_GT(found, 300);
  EXPECT_GT(none, 20);
}

TEST(LeastCostPath, SumsItsCellsBothEndsIncluded) {
  const auto risk = testing::Rows<double>({{1, 9, 1, 1},  //
                                           {1, 9, 1, 9},  //
                                           {1, 1, 3, 1}});
  const Grid<std::uint8_t> open(4, 3, 1);
  const auto cost = [&](Cell c) { return risk(c); };
  // 1 + 1 + 1 + 1 + 3 + 1 round the 9s.
  EXPECT_EQ(LeastCostPath(open, {{0, 2}}, cost,
                          [](Cell c) {
                            return c == Cell{2, 1};
                          }),
            (std::vector<Cell>{{0, 2}, {0, 1}, {0, 0}, {1, 0}, {2, 0}, {2, 1}}));
  // The goal's own cost counts, and so does the source's.
  EXPECT_EQ(LeastCostPath(open, {{2, 0}}, cost, [](Cell c) { return c.iy == 1 && c.ix > 0; }),
            (std::vector<Cell>{{2, 0}, {2, 1}}));
  EXPECT_EQ(LeastCostPath(open, {{1, 2}, {3, 2}, {1, 1}}, cost, [](Cell c) { return c.ix == 2; }),
            (std::vector<Cell>{{3, 2}, {2, 2}}));
  EXPECT_EQ(LeastCostPath(open, {{2, 0}}, cost, [](Cell) { return true; }),
            (std::vector<Cell>{{2, 0}}));
}

TEST(LeastCostPath, NoWayHasLess) {
  Stream random(3, 0, "sums");
  int found = 0;
  for (int round = 0; round < 60; ++round) {
    const Grid<std::uint8_t> open = RandomCells(random, 13, 9, 0.3);
    Grid<double> risk(13, 9);
    for (double& r : risk.cells) r = static_cast<double>(random.Below(4));  // 0 too
    const auto cost = [&](Cell c) { return risk(c); };
    const std::vector<Cell> from = {RandomOpen(random, open), RandomOpen(random, open)};
    const Cell a = RandomOpen(random, open), b = RandomOpen(random, open);
    const Grid<double> sums = LeastSums(open, from, cost);
    const auto way = LeastCostPath(open, from, cost, [&](Cell c) { return c == a || c == b; });
    const double least = std::min(sums(a), sums(b));
    ASSERT_EQ(way.empty(), least == kNone);
    if (way.empty()) continue;
    ++found;
    ExpectWay(open, way);
    ASSERT_TRUE(way.front() == from[0] || way.front() == from[1]);
    double sum = 0;
    for (const Cell cell : way) sum += cost(cell);
    ASSERT_EQ(sum, least);
  }
  EXPECT_GT(found, 30);
}

}  // namespace
}  // namespace floorproof
