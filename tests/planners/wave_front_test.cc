// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "base/streams.h"
#include "planners/risk/terrain_wave.h"
#include "tests/planners/risk_floors.h"

namespace floorproof {
namespace {

using testing::DrawRisk;
using testing::OpenCells;
using testing::Rows;

constexpr double kNo = kOutOfReach;

Grid<std::uint8_t> FreeCells(const RiskMap& risk) {
  Grid<std::uint8_t> open(risk.rf.width, risk.rf.height);
  for (std::size_t i = 0; i < open.cells.size(); ++i)
    open.cells[i] = risk.grid.contents.cells[i].free();
  return open;
}

// The terrain that WaveOverTerrain opened.
std::vector<Cell> Opened(const RiskMap& risk, const Grid<std::uint8_t>& open) {
  std::vector<Cell> cells;
  for (std::size_t i = 0; i < open.cells.size(); ++i)
    if (open.cells[i] && !risk.grid.contents.cells[i].free()) cells.push_back(CellAt(open, i));
  return cells;
}

TEST(WaveFront, StepsScore15AndCorners20) {
  EXPECT_EQ(WaveFront(OpenCells("....\n....\n....\n"), {0, 0}).cells,
            Rows<double>({{30, 35, 40, 55},  //
                          {15, 20, 35, 50},  //
                          {0, 15, 30, 45}})
                .cells);
  EXPECT_EQ(WaveFront(OpenCells("...\n...\n...\n"), {1, 1}).cells,
            Rows<double>({{20, 15, 20}, {15, 0, 15}, {20, 15, 20}}).cells);
}

TEST(WaveFront, CutsNoCorners) {
  EXPECT_EQ(WaveFront(OpenCells("...\n.#.\n...\n"), {0, 0}).cells, Rows<double>({{30, 45, 60},   //
                                                                                 {15, kNo, 45},  //
                                                                                 {0, 15, 30}})
                                                                       .cells);
  EXPECT_EQ(WaveFront(OpenCells("..\n#.\n"), {1, 0}).cells,
            Rows<double>({{30, 15}, {kNo, 0}}).cells)
      << "one closed cell is enough";
  EXPECT_EQ(WaveFront(OpenCells("#.\n.#\n"), {0, 0}).cells,
            Rows<double>({{kNo, kNo}, {0, kNo}}).cells)
      << "between two closed cells nobody passes";
}

TEST(WaveFront, AddsWhatIsSaidOfEachCellEntered) {
  const auto more = Rows<double>({{1, 2, 4}, {100, 8, 16}});
  EXPECT_EQ(WaveFront(OpenCells("...\n...\n"), {0, 0}, [&](Cell c) { return more(c); }).cells,
            Rows<double>({{16, 22, 41},  // up, a corner, and on over the cheaper of two ways
                          {0, 23, 54}})
                .cells);
}

// Scores settle at the least over all last steps: what defines them.
TEST(WaveFront, EachScoreIsItsBestNeighboursAndAStep) {
  Stream random(1, 0, "waves");
  for (int round = 0; round < 40; ++round) {
    Grid<std::uint8_t> open(14, 11);
    for (std::uint8_t& cell : open.cells) cell = random.Uniform() < 0.7;
    Grid<double> more(14, 11);
    if (round % 2)
      for (double& value : more.cells) value = random.Uniform(0, 20);
    const Cell end{3, 4};
    open(end) = 1;
    const Grid<double> dut = WaveFront(open, end, [&](Cell c) { return more(c); });
    ASSERT_EQ(dut(end), 0);
    const auto is_open = [&](int x, int y) { return open.Inside(x, y) && open(x, y); };
    const Grid<std::int32_t> steps = StepsFrom(open, end);
    for (int y = 0; y < 11; ++y)
      for (int x = 0; x < 14; ++x) {
        ASSERT_EQ(dut(x, y) < kNo, steps(x, y) >= 0);
        if (!is_open(x, y) || Cell{x, y} == end) continue;
        double best = kNo;
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx) {
            if ((dx == 0 && dy == 0) || !is_open(x + dx, y + dy)) continue;
            if (!is_open(x + dx, y) || !is_open(x, y + dy)) continue;
            best =
                std::min(best, dut(x + dx, y + dy) + (dx != 0 && dy != 0 ? 20 : 15) + more(x, y));
          }
        ASSERT_EQ(dut(x, y), best) << x << ", " << y;
      }
  }
}

TEST(WaveOverTerrain, OpensTheLeastCellOfAStripAcrossTheFloor) {
  const char kStrip[] = R"(
      ...=...
      ...=...
      ...=...
      ...=...
      ...=...)";
  for (int least = 0; least < 5; ++least) {
    const RiskMap risk =
        DrawRisk(kStrip, [&](Cell c) { return c.iy == least && c.ix == 3 ? 1.0 : 1.5; });
    Grid<std::uint8_t> open = FreeCells(risk);
    const Grid<double> dut = WaveOverTerrain(risk, {0, 0}, open);
    EXPECT_EQ(Opened(risk, open), (std::vector<Cell>{{3, least}}));
    EXPECT_EQ(dut.cells, WaveFront(open, {0, 0}).cells) << "begun anew over what is open";
    for (std::size_t i = 0; i < open.cells.size(); ++i)
      EXPECT_EQ(dut.cells[i] < kNo, open.cells[i] == 1);
  }
}

TEST(WaveOverTerrain, OpensNothingWhereTheFloorIsWhole) {
  const RiskMap risk = DrawRisk(R"(
      ...=...
      ...=...
      .......
      .==....)");
  Grid<std::uint8_t> open = FreeCells(risk);
  const Grid<double> dut = WaveOverTerrain(risk, {0, 0}, open);
  EXPECT_TRUE(Opened(risk, open).empty());
  EXPECT_EQ(dut.cells, WaveFront(FreeCells(risk), {0, 0}).cells);
}

TEST(WaveOverTerrain, OpensTerrainOnlyWhereItCanBeCrossed) {
  // The least RF of all terrain leads nowhere: a patch, and a strip's end in a wall.
  const RiskMap risk = DrawRisk(R"(
      =..=...
      ...=...
      ...=...
      ...=###)",
                                [](Cell c) {
                                  if (c == Cell{0, 3}) return 0.1;
                                  if (c == Cell{3, 0}) return 0.2;
                                  return c == Cell{3, 2} ? 1.0 : 1.5;
                                });
  Grid<std::uint8_t> open = FreeCells(risk);
  WaveOverTerrain(risk, {0, 0}, open);
  EXPECT_EQ(Opened(risk, open), (std::vector<Cell>{{3, 2}}));
}

TEST(WaveOverTerrain, ThickTerrainIsCrossedWhereTheSumIsLeast) {
  // Row 0 holds the single least cell, row 2 the least sum; a bend of three cells has less still.
  const auto rf = Rows<double>({{0, 0, 4, 4, 0, 0},  //
                                {0, 0, 2, 3, 0, 0},  //
                                {0, 0, 4, 4, 0, 0},  //
                                {0, 0, 1, 9, 0, 0}});
  RiskMap risk = DrawRisk("..==..\n..==..\n..==..\n..==..\n", [&](Cell c) { return rf(c); });
  Grid<std::uint8_t> open = FreeCells(risk);
  WaveOverTerrain(risk, {0, 0}, open);
  EXPECT_EQ(Opened(risk, open), (std::vector<Cell>{{2, 2}, {3, 2}}));

  const auto bend = Rows<double>({{0, 0, 4, 4, 0, 0},  //
                                  {0, 0, 9, 1, 0, 0},  //
                                  {0, 0, 1, 1, 0, 0},  //
                                  {0, 0, 9, 9, 0, 0}});
  risk = DrawRisk("..==..\n..==#.\n..==#.\n..==..\n", [&](Cell c) { return bend(c); });
  open = FreeCells(risk);
  WaveOverTerrain(risk, {0, 0}, open);
  EXPECT_EQ(Opened(risk, open), (std::vector<Cell>{{2, 1}, {3, 1}, {3, 2}, {3, 3}}));
}

TEST(WaveOverTerrain, OpensOneCrossingForEachPartOfTheFloor) {
  const RiskMap risk = DrawRisk(R"(
      ..=..=..
      ..=..=..
      ..=..===
      ..=..=..)");
  Grid<std::uint8_t> open = FreeCells(risk);
  const Grid<double> dut = WaveOverTerrain(risk, {7, 3}, open);
  EXPECT_EQ(Opened(risk, open).size(), 3u);
  for (std::size_t i = 0; i < open.cells.size(); ++i) {
    if (risk.grid.contents.cells[i].free()) {
      EXPECT_LT(dut.cells[i], kNo) << i;
    }
  }
}

// However it is computed: opened terrain may shorten ways to cells that were reached before.
TEST(WaveOverTerrain, IsTheWaveBegunAnewOverWhatIsOpen) {
  Stream random(5, 0, "terrain");
  int crossings = 0;
  for (int floor = 0; floor < 60; ++floor) {
    std::string drawing;
    for (int iy = 0; iy < 12; ++iy, drawing += '\n')
      for (int ix = 0; ix < 12; ++ix) drawing += random.Uniform() < 0.35 ? '=' : '.';
    drawing[0] = '.';
    const RiskMap risk = DrawRisk(drawing);
    Grid<std::uint8_t> open = FreeCells(risk);
    const Grid<double> dut = WaveOverTerrain(risk, {0, 11}, open);
    EXPECT_EQ(dut.cells, WaveFront(open, {0, 11}).cells);
    crossings += !Opened(risk, open).empty();
  }
  EXPECT_GT(crossings, 40);
}

TEST(WaveOverTerrain, WhatNoTerrainLeadsToStaysOutOfReach) {
  const RiskMap risk = DrawRisk(R"(
      ...#...
      ...#...
      .=.v.=.
      ...G...)");
  Grid<std::uint8_t> open = FreeCells(risk);
  const Grid<double> dut = WaveOverTerrain(risk, {0, 0}, open);
  EXPECT_TRUE(Opened(risk, open).empty());
  EXPECT_EQ(dut(2, 3), WaveFront(FreeCells(risk), {0, 0})(2, 3));
  for (int iy = 0; iy < 4; ++iy)
    for (int ix = 4; ix < 7; ++ix) EXPECT_EQ(dut(ix, iy), kNo);
  // Nor is solid terrain crossed.
  RiskMap solid = DrawRisk("..=..\n");
  solid.grid.contents(2, 0).solid = true;
  open = FreeCells(solid);
  EXPECT_EQ(WaveOverTerrain(solid, {0, 0}, open)(4, 0), kNo);
  EXPECT_TRUE(Opened(solid, open).empty());
}

TEST(WaveOverTerrain, WhatIsNotWantedIsNotOpened) {
  // Free cells that are left out (of high risk) stay closed, and no way is opened to them.
  const RiskMap risk = DrawRisk("..=..\n..=..\n");
  Grid<std::uint8_t> open = FreeCells(risk);
  open(3, 0) = open(4, 0) = open(3, 1) = open(4, 1) = 0;
  WaveOverTerrain(risk, {0, 0}, open);
  EXPECT_EQ(std::ranges::count(open.cells, 1), 4);
}

}  // namespace
}  // namespace floorproof
