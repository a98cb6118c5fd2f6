// SPDX-License-Identifier: Apache-2.0
#include "planners/risk/high_risk.h"

#include <gtest/gtest.h>

#include "planners/risk/terrain_wave.h"
#include "tests/planners/risk_floors.h"

namespace floorproof {
namespace {

using testing::DrawRisk;

// The task of covering all that floor and terrain lead to from `start`.
CellTask Task(const RiskMap& risk, Cell start, Cell end) {
  CellTask task{risk, start, end, {risk.rf.width, risk.rf.height}, {}};
  Grid<std::uint8_t> drivable(risk.rf.width, risk.rf.height);
  for (std::size_t i = 0; i < drivable.cells.size(); ++i)
    drivable.cells[i] = !risk.grid.contents.cells[i].solid;
  const Grid<std::int32_t> steps = StepsFrom(drivable, start);
  for (std::size_t i = 0; i < drivable.cells.size(); ++i) {
    drivable.cells[i] = steps.cells[i] >= 0;
    task.free.cells[i] = drivable.cells[i] && risk.grid.contents.cells[i].free();
  }
  task.drivable = drivable;
  return task;
}

LowRisk Low(const RiskMap& risk, Cell start, Cell end, std::optional<double> share = {}) {
  HighRiskParams params;
  params.share = share;
  return LowRiskFloor(Task(risk, start, end), params);
}

// Ten rows of ten; the RF grows along the rows from 0 to 99.
std::string Hall(char hazard_at_0) {
  std::string rows;
  for (int iy = 0; iy < 9; ++iy) rows += "..........\n";
  return rows + hazard_at_0 + ".........\n";
}
double Index(Cell c) { return c.ix + 10.0 * c.iy; }

TEST(HighRisk, Is15PercentWithLevelChangesAnd3Without) {
  const std::pair<char, int> shares[] = {{'v', 15}, {'=', 3}, {'G', 3}, {'#', 3}, {'.', 3}};
  for (const auto& [hazard, high] : shares) {
    const RiskMap risk = DrawRisk(Hall(hazard), Index);
    const LowRisk dut = Low(risk, {1, 0}, {5, 0});
    EXPECT_EQ(dut.high_risk_cells, high) << hazard;
    EXPECT_EQ(dut.cut_off_cells, 0);
    EXPECT_EQ(dut.opened_cells, 0);
    for (int iy = 0; iy < 10; ++iy)
      for (int ix = 0; ix < 10; ++ix) {
        const bool hazard_cell = ix == 0 && iy == 0 && hazard != '.';
        EXPECT_EQ(dut.open(ix, iy), !hazard_cell && Index({ix, iy}) < 100 - high)
            << hazard << ": " << ix << ", " << iy;
      }
  }
}

TEST(HighRisk, TheShareIsOfAllCellsWithinTheOuterWalls) {
  // 5 x 4 cells within; hazards are of them, and their cells count among the highest.
  const RiskMap risk = DrawRisk(R"(
      #######
      #.....#
      #.....#
      #.....#
      #v....#
      #######)",
                                [](Cell c) {
                                  return c == Cell{1, 1} ? 99.0 : c.ix + 7.0 * c.iy;
                                });
  const LowRisk dut = Low(risk, {1, 2}, {2, 2});  // 15 % of 20: three, one of them the drop
  EXPECT_EQ(dut.high_risk_cells, 2);
  EXPECT_FALSE(dut.open(5, 4));
  EXPECT_FALSE(dut.open(4, 4));
  EXPECT_TRUE(dut.open(3, 4));
}

TEST(HighRisk, OfEqualsAllOrNone) {
  // Sixteen cells share the highest RF where 15 are wanted: none is high.
  const auto sixteen = [](Cell c) { return Index(c) >= 84 ? 100.0 : 1.0; };
  EXPECT_EQ(Low(DrawRisk(Hall('v'), sixteen), {1, 0}, {5, 0}).high_risk_cells, 0);
  const auto fifteen = [](Cell c) { return Index(c) >= 85 ? 100.0 : 1.0; };
  EXPECT_EQ(Low(DrawRisk(Hall('v'), fifteen), {1, 0}, {5, 0}).high_risk_cells, 15);
  // Ten are higher than the ten that follow: those ten alone.
  const auto steps = [](Cell c) { return static_cast<double>(c.iy); };
  EXPECT_EQ(Low(DrawRisk(Hall('v'), steps), {1, 0}, {5, 0}).high_risk_cells, 10);
}

TEST(HighRisk, WithoutHazardsNothingIsHigh) {
  const LowRisk dut = Low(DrawRisk(Hall('.')), {0, 0}, {9, 9});
  EXPECT_EQ(dut.high_risk_cells, 0);
  EXPECT_EQ(std::ranges::count(dut.open.cells, 1), 100);
}

TEST(HighRisk, AShareCanBeGiven) {
  const RiskMap risk = DrawRisk(Hall('v'), Index);
  EXPECT_EQ(Low(risk, {1, 0}, {5, 0}, 0.0).high_risk_cells, 0);
  EXPECT_EQ(Low(risk, {1, 0}, {5, 0}, 0.4).high_risk_cells, 40);
  EXPECT_EQ(Low(risk, {1, 0}, {5, 0}, 0.005).high_risk_cells, 0);
  // All: but for the way from start to end.
  const LowRisk all = Low(risk, {1, 0}, {5, 0}, 1.0);
  EXPECT_EQ(all.high_risk_cells, 99 - 5);
  EXPECT_EQ(std::ranges::count(all.open.cells, 1), 5);
}

TEST(HighRisk, StartAndEndAreNeverLeftOut) {
  const RiskMap risk = DrawRisk(Hall('v'), Index);
  const LowRisk dut = Low(risk, {9, 9}, {0, 9});
  EXPECT_TRUE(dut.open(9, 9));
  EXPECT_TRUE(dut.open(0, 9));
  EXPECT_LT(dut.wave(9, 9), kOutOfReach);
}

TEST(HighRisk, TheEndIsNeverCutOffAndTheWayTakesTheLeastBack) {
  // A bar of high risk across a corridor.
  const RiskMap risk =
      DrawRisk(R"(
      ..........
      ..........
      .......v..)",
               [](Cell c) { return c.ix == 4 ? 10.0 + (c.iy - 1) * (c.iy - 1) : 1; });
  const LowRisk dut = Low(risk, {0, 0}, {9, 0});  // 15 % of 30 cells: four at most
  EXPECT_EQ(dut.high_risk_cells, 2);
  EXPECT_FALSE(dut.open(4, 0));
  EXPECT_TRUE(dut.open(4, 1)) << "the least of them";
  EXPECT_FALSE(dut.open(4, 2));
  EXPECT_EQ(dut.cut_off_cells, 0);
  EXPECT_LT(dut.wave(0, 0), kOutOfReach);
}

TEST(HighRisk, WhatItCutsOffElseIsLeftOut) {
  // The same bar, and the end before it.
  const RiskMap risk = DrawRisk(R"(
      .....
      .....
      ....v)",
                                [](Cell c) { return c.ix == 3 ? 10.0 : 1; });
  const LowRisk dut = Low(risk, {0, 0}, {0, 2}, 0.2);  // three cells
  EXPECT_EQ(dut.high_risk_cells, 3);
  EXPECT_EQ(dut.cut_off_cells, 2);
  EXPECT_FALSE(dut.open(4, 2));
  EXPECT_EQ(std::ranges::count(dut.open.cells, 1), 9);
}

TEST(HighRisk, TerrainIsOpenedWhereItHasToBeAndNowhereElse) {
  const RiskMap risk = DrawRisk(R"(
      ....=....
      .=..=....
      ....=....)",
                                [](Cell c) {
                                  return c == Cell{4, 1} ? 2.0 : 2.5;
                                });
  const LowRisk dut = Low(risk, {0, 0}, {8, 0});
  EXPECT_EQ(dut.opened_cells, 1);
  EXPECT_TRUE(dut.open(4, 1));
  EXPECT_EQ(std::ranges::count(dut.open.cells, 1), 27 - 4 + 1);
  for (std::size_t i = 0; i < dut.open.cells.size(); ++i)
    EXPECT_EQ(dut.wave.cells[i] < kOutOfReach, dut.open.cells[i] == 1) << i;
}

TEST(HighRisk, TerrainOfHighRiskIsStillCrossed) {
  // High-risk cells count as obstacles where they are free; across a strip there is no other way.
  const RiskMap risk = DrawRisk("..=..\n..=..\n", [](Cell c) { return c.ix == 2 ? 9.0 : 1; });
  const LowRisk dut = Low(risk, {0, 0}, {4, 0}, 0.2);
  EXPECT_EQ(dut.high_risk_cells, 0);
  EXPECT_EQ(dut.opened_cells, 1);
  EXPECT_LT(dut.wave(0, 0), kOutOfReach);
}

}  // namespace
}  // namespace floorproof
