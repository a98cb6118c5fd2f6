// SPDX-License-Identifier: Apache-2.0
#include "planners/walk/transform_tour.h"

#include <gtest/gtest.h>

#include "base/streams.h"
#include "planners/walk/wave_front.h"
#include "tests/planners/risk_floors.h"

namespace floorproof {
namespace {

using testing::ExpectWay;
using testing::OpenCells;
using testing::Rows;

using Cells = std::vector<Cell>;

TEST(TransformTour, TakesTheHighestOfFourNeighbours) {
  const auto score = Rows<double>({{7, 6, 5},  //
                                   {8, 0, 4},  //
                                   {1, 2, 3}});
  const CellTour dut = TransformTour(OpenCells("...\n...\n...\n"), score, {0, 0}, {1, 1});
  EXPECT_EQ(dut.cells,
            (Cells{{0, 0}, {0, 1}, {0, 2}, {1, 2}, {2, 2}, {2, 1}, {2, 0}, {1, 0}, {1, 1}}));
  EXPECT_EQ(dut.dead_ends, 0);
}

TEST(TransformTour, ACornerIsNoNeighbour) {
  const auto score = Rows<double>({{1, 9},  //
                                   {0, 2}});
  const CellTour dut = TransformTour(OpenCells("..\n..\n"), score, {0, 0}, {0, 1});
  EXPECT_EQ(dut.cells, (Cells{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
}

TEST(TransformTour, OfEqualsTheFirstOfUpDownRightLeft) {
  const Grid<double> flat(3, 3, 5.0);
  const auto second = [&](const std::string& rows) {
    return TransformTour(OpenCells(rows), flat, {1, 1}, {1, 1}).cells.at(1);
  };
  EXPECT_EQ(second("...\n...\n...\n"), (Cell{1, 2}));
  EXPECT_EQ(second("###\n...\n...\n"), (Cell{1, 0}));
  EXPECT_EQ(second("###\n...\n###\n"), (Cell{2, 1}));
  EXPECT_EQ(second("###\n..#\n###\n"), (Cell{0, 1}));
}

TEST(TransformTour, TheEndComesLastThoughItScoresHighest) {
  const auto score = Rows<double>({{1, 1, 1},  //
                                   {1, 9, 1}});
  const CellTour dut = TransformTour(OpenCells("...\n...\n"), score, {0, 0}, {1, 0});
  EXPECT_EQ(dut.cells, (Cells{{0, 0}, {0, 1}, {1, 1}, {2, 1}, {2, 0}, {1, 0}}));
}

TEST(TransformTour, TheEndIsPassedWhereTheOnlyWayLeadsOverIt) {
  const CellTour dut = TransformTour(OpenCells(".....\n"), Grid<double>(5, 1), {0, 0}, {2, 0});
  EXPECT_EQ(dut.cells, (Cells{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {3, 0}, {2, 0}}));
}

TEST(TransformTour, FromADeadEndItGoesToTheNearestRing) {
  // Along the upper row into the dead end at its right; (3, 1) is the nearest unvisited cell by
  // rings, (0, 0) is not.
  const auto score = Rows<double>({{5, 6, 7, 8, 9},  //
                                   {1, 0, 0, 0, 0}});
  const CellTour dut = TransformTour(OpenCells(".....\n...##\n"), score, {0, 1}, {0, 0});
  EXPECT_EQ(dut.cells, (Cells{{0, 1},
                              {1, 1},
                              {2, 1},
                              {3, 1},
                              {4, 1},  // dead end
                              {3, 1},
                              {2, 1},
                              {2, 0},
                              {1, 0},
                              {0, 0}}));
  EXPECT_EQ(dut.dead_ends, 1);
}

TEST(TransformTour, ADeadEndLeavesOtherCellsThanTheEnd) {
  // Section 2.3: "and there are non-visited cells remaining other than the end point".
  const CellTour dut = TransformTour(OpenCells("....\n"), Grid<double>(4, 1), {1, 0}, {0, 0});
  EXPECT_EQ(dut.cells, (Cells{{1, 0}, {2, 0}, {3, 0}, {2, 0}, {1, 0}, {0, 0}}));
  EXPECT_EQ(dut.dead_ends, 0);
  EXPECT_EQ(
      TransformTour(OpenCells("...\n.#.\n.#.\n"), Grid<double>(3, 3), {1, 2}, {1, 2}).dead_ends, 1);
}

TEST(TransformTour, OneCellAndThereAndBack) {
  EXPECT_EQ(TransformTour(OpenCells("."), Grid<double>(1, 1), {0, 0}, {0, 0}).cells,
            (Cells{{0, 0}}));
  EXPECT_EQ(TransformTour(OpenCells(".."), Grid<double>(2, 1), {0, 0}, {1, 0}).cells,
            (Cells{{0, 0}, {1, 0}}));
  EXPECT_EQ(TransformTour(OpenCells(".."), Grid<double>(2, 1), {0, 0}, {0, 0}).cells,
            (Cells{{0, 0}, {1, 0}, {0, 0}}));
}

// On random floors, what Algorithms 2 and 3 promise of each step.
TEST(TransformTour, OnAnyFloorItVisitsAllGoesUphillAndEndsAtTheEnd) {
  Stream random(1, 0, "tours");
  int dead_ends = 0;
  for (int round = 0; round < 80; ++round) {
    const int width = 1 + static_cast<int>(random.Below(16)),
              height = 2 + static_cast<int>(random.Below(12));
    Grid<std::uint8_t> open(width, height);
    for (std::uint8_t& cell : open.cells) cell = random.Uniform() < 0.75;
    const Cell start = CellAt(open, random.Below(open.cells.size()));
    open(start) = 1;
    const Grid<std::int32_t> steps = StepsFrom(open, start);
    Cell end = start;
    for (std::size_t i = 0; i < open.cells.size(); ++i) {
      open.cells[i] = steps.cells[i] >= 0;
      if (open.cells[i] && random.Uniform() < 0.1) end = CellAt(open, i);
    }
    Grid<double> score = WaveFront(open, end);
    if (round % 2)
      for (double& s : score.cells) s -= random.Uniform(0, 50);
    const CellTour dut = TransformTour(open, score, start, end);
    ExpectWay(open, dut.cells);
    ASSERT_EQ(dut.cells.front(), start);
    ASSERT_EQ(dut.cells.back(), end);
    Grid<std::uint8_t> visited(width, height);
    auto left = std::ranges::count(open.cells, 1);
    std::size_t at = 0;
    int stuck = 0;
    const auto visit = [&] {
      left -= !visited(dut.cells[at]);
      visited(dut.cells[at]) = 1;
    };
    const auto wanted = [&](Cell c) {
      return open.Inside(c) && open(c) && !visited(c) && (left == 1 || !(c == end));
    };
    const auto follow = [&](const std::vector<Cell>& way) {
      ASSERT_GE(way.size(), 2u);
      ASSERT_LT(at + way.size() - 1, dut.cells.size());
      for (std::size_t k = 1; k < way.size(); ++k) {
        ASSERT_EQ(dut.cells[++at], way[k]) << at;
        visit();
      }
    };
    GridPaths ways(open);
    visit();
    while (left > 0) {
      double best = -1e9;
      for (const Cell step : kSideSteps)
        if (wanted(dut.cells[at] + step)) best = std::max(best, score(dut.cells[at] + step));
      if (best == -1e9) {
        stuck += left > 1 || visited(end);
        ASSERT_NO_FATAL_FAILURE(follow(ways.ToNearestRing(dut.cells[at], wanted)));
        continue;
      }
      ASSERT_LT(++at, dut.cells.size());
      ASSERT_TRUE(wanted(dut.cells[at])) << at;
      ASSERT_EQ(score(dut.cells[at]), best) << at;
      visit();
    }
    if (!(dut.cells[at] == end)) {
      ASSERT_NO_FATAL_FAILURE(follow(ways.Shortest(dut.cells[at], end)));
    }
    ASSERT_EQ(at + 1, dut.cells.size());
    ASSERT_EQ(dut.dead_ends, stuck);
    dead_ends += stuck;
  }
  EXPECT_GT(dead_ends, 50);
}

}  // namespace
}  // namespace floorproof
