// SPDX-License-Identifier: Apache-2.0
#include "planners/risk/risk_meter.h"

#include <gtest/gtest.h>

#include <numeric>

#include "base/streams.h"
#include "tests/planners/risk_floors.h"

namespace floorproof {
namespace {

using testing::DrawRisk;
using testing::PathOf;

// Cells of 1 m; the RF of (x, y) is 1 + x + 10 y.
RiskMap Numbered(const std::string& rows) {
  return DrawRisk(rows, [](Cell c) { return 1.0 + c.ix + 10 * c.iy; });
}

RiskOfPath Measure(const RiskMap& risk, const std::vector<Vec2>& points) {
  return MeasureRisk(risk, PathOf(points));
}

TEST(RiskMeter, EachCellOnAStraightWayIsVisitedOnce) {
  const RiskMap risk = Numbered(".....\n.....\n");
  const RiskOfPath dut = Measure(risk, {{0.5, 0.5}, {4.5, 0.5}});
  EXPECT_EQ(dut.visits, 5);
  EXPECT_EQ(dut.cells, 5);
  EXPECT_EQ(dut.cumulative_risk, 1 + 2 + 3 + 4 + 5);
  EXPECT_EQ(dut.each_cell_once, 15);
  EXPECT_EQ(dut.visits_of.cells, (std::vector<std::int32_t>{1, 1, 1, 1, 1, 0, 0, 0, 0, 0}));
  EXPECT_EQ(dut.coverage, 0.5);
}

TEST(RiskMeter, ComingBackIsAnotherVisitTurningRoundIsNone) {
  const RiskMap risk = Numbered(".....\n");
  const RiskOfPath dut = Measure(risk, {{0.5, 0.5}, {2.5, 0.5}, {0.5, 0.5}});
  EXPECT_EQ(dut.visits_of.cells, (std::vector<std::int32_t>{2, 2, 1, 0, 0}));
  EXPECT_EQ(dut.visits, 5);
  EXPECT_EQ(dut.cells, 3);
  EXPECT_EQ(dut.cumulative_risk, 2 * 1 + 2 * 2 + 3);
  EXPECT_EQ(dut.each_cell_once, 1 + 2 + 3);
  EXPECT_EQ(dut.coverage, 0.6);
}

TEST(RiskMeter, WhoWaversOnABorderVisitsOneCell) {
  const RiskMap risk = Numbered(".....\n.....\n");
  std::vector<Vec2> points = {{0.5, 0.5}};
  for (int i = 0; i < 40; ++i) points.push_back({0.5, 1 + (i % 2 ? 0.09 : -0.09)});
  EXPECT_EQ(Measure(risk, points).visits, 1);
  EXPECT_EQ(Measure(risk, {{0.5, 0.5}, {0.5, 1.08}, {0.5, 0.5}}).visits, 1);
  // More than a tenth beyond it is a visit.
  EXPECT_EQ(Measure(risk, {{0.5, 0.5}, {0.5, 1.12}}).visits, 2);
  EXPECT_EQ(Measure(risk, {{0.5, 0.5}, {0.5, 1.12}, {0.5, 0.5}}).visits, 3);
}

TEST(RiskMeter, WhoDrivesAlongABorderVisitsTheCellsOfOneSide) {
  const RiskMap risk = Numbered(".....\n.....\n");
  for (const double y : {0.95, 1.0, 1.05}) {
    const RiskOfPath dut = Measure(risk, {{0.5, 0.5}, {0.5, y}, {4.5, y}});
    EXPECT_EQ(dut.visits, 5) << y;
    for (int ix = 0; ix < 5; ++ix) EXPECT_EQ(dut.visits_of(ix, 0) + dut.visits_of(ix, 1), 1) << y;
  }
  std::vector<Vec2> points = {{0.5, 0.5}};
  for (int i = 0; i < 40; ++i) points.push_back({0.5 + 0.1 * i, 1 + (i % 2 ? 0.09 : -0.09)});
  EXPECT_EQ(Measure(risk, points).visits, 5);
}

TEST(RiskMeter, ADiagonalPassesCorners) {
  const RiskOfPath dut = Measure(Numbered("...\n...\n...\n"), {{0.5, 0.5}, {2.5, 2.5}});
  EXPECT_EQ(dut.visits_of.cells, (std::vector<std::int32_t>{1, 0, 0, 0, 1, 0, 0, 0, 1}));
  EXPECT_EQ(dut.cumulative_risk, 1 + 12 + 23);
}

TEST(RiskMeter, TheStartIsAVisitWhereverInItsCell) {
  const RiskMap risk = Numbered("...\n");
  EXPECT_EQ(Measure(risk, {{0.5, 0.5}}).visits, 1);
  EXPECT_EQ(Measure(risk, {{0.95, 0.03}}).visits, 1);
  EXPECT_EQ(Measure(risk, {{0.95, 0.5}, {0.5, 0.5}}).visits, 1);
  EXPECT_EQ(Measure(risk, {{0.95, 0.5}, {1.5, 0.5}}).visits_of.cells,
            (std::vector<std::int32_t>{1, 1, 0}));
  EXPECT_EQ(Measure(risk, {{0.5, 0.5}, {0.5, 0.5}, {0.5, 0.5}}).visits, 1) << "standing";
}

TEST(RiskMeter, OffTheMapIsNoCell) {
  const RiskMap risk = Numbered("..\n..\n");
  const RiskOfPath dut = Measure(risk, {{-5, 0.5}, {0.5, 0.5}, {0.5, 9}, {1.5, 9}, {1.5, 1.5}});
  EXPECT_EQ(dut.visits_of.cells, (std::vector<std::int32_t>{1, 0, 1, 1}));
}

TEST(RiskMeter, TheMapsFrameIsItsOwn) {
  HazardMap map = testing::DrawHazards(".....\n..=..\n", 0.4, {3, -1, 2.1});
  const RiskMap risk = ComputeRisk(map, testing::DiscRobot(0.2, 0.4), testing::PaperTables());
  const RiskOfPath dut = Measure(risk, {map.frame.Center(0, 0), map.frame.Center(4, 0),
                                        map.frame.Center(4, 1), map.frame.Center(3, 1)});
  EXPECT_EQ(dut.visits_of.cells, (std::vector<std::int32_t>{1, 1, 1, 1, 1, 0, 0, 0, 1, 1}));
  EXPECT_EQ(dut.terrain_crossings, 1);
}

TEST(RiskMeter, ACrossingIsARunOfVisitsToTerrain) {
  const RiskMap risk = Numbered(R"(
      ..==..=
      ..==..=
      ..==..=)");
  EXPECT_EQ(Measure(risk, {{0.5, 0.5}, {5.5, 0.5}}).terrain_crossings, 1);
  EXPECT_EQ(Measure(risk, {{0.5, 0.5}, {5.5, 0.5}, {0.5, 0.5}}).terrain_crossings, 2);
  EXPECT_EQ(Measure(risk, {{0.5, 0.5}, {6.5, 0.5}}).terrain_crossings, 2);
  EXPECT_EQ(
      Measure(risk,
              {{0.5, 0.5}, {2.5, 0.5}, {2.5, 2.5}, {3.5, 2.5}, {3.5, 0.5}, {2.5, 0.5}, {0.5, 0.5}})
          .terrain_crossings,
      1)
      << "along it is the same crossing";
  EXPECT_EQ(Measure(risk, {{2.5, 0.5}, {0.5, 0.5}}).terrain_crossings, 1) << "begun on it";
  EXPECT_EQ(Measure(risk, {{0.5, 0.5}, {1.5, 2.5}}).terrain_crossings, 0);
  EXPECT_EQ(Measure(Numbered("vG#.\n"), {{0.5, 0.5}, {3.5, 0.5}}).terrain_crossings, 0);
}

TEST(RiskMeter, WhoIsCarriedVisitsNothingOnTheWay) {
  const RiskMap risk = Numbered("..=..\n");
  RiskMeter dut(risk);
  dut.Add({0.5, 0.5});
  dut.Lift();
  dut.Add({4.5, 0.5});
  EXPECT_EQ(dut.visits_of().cells, (std::vector<std::int32_t>{1, 0, 0, 0, 1}));
  EXPECT_EQ(dut.terrain_crossings(), 0);
  EXPECT_EQ(dut.cumulative_risk(), 1 + 5);
  dut.Lift();
  dut.Add({4.5, 0.5});  // set down where it was taken up
  EXPECT_EQ(dut.visits(), 3);
  dut.Add({3.5, 0.5});
  EXPECT_EQ(dut.visits_of().cells, (std::vector<std::int32_t>{1, 0, 0, 1, 2}));
}

TEST(RiskMeter, HowFinelyAWayIsWrittenDoesNotMatter) {
  Stream random(1, 0, "walk");
  const RiskMap risk = Numbered(R"(
      ......=...
      .==...=...
      ......=.=.
      ..........)");
  for (int round = 0; round < 20; ++round) {
    std::vector<Vec2> coarse = {{0.5, 0.5}}, fine = coarse;
    double sum = 1;
    int cells = 1;
    for (int i = 0; i < 60; ++i) {
      const Cell step = kSideSteps[random.Below(4)];
      const Vec2 from = coarse.back(), to = from + Vec2(step.ix, step.iy);
      if (to.x() < 0 || to.y() < 0 || to.x() > 10 || to.y() > 4) continue;
      coarse.push_back(to);
      sum += risk.rf(static_cast<int>(to.x()), static_cast<int>(to.y()));
      ++cells;
      for (int s = 1; s <= 37; ++s) fine.push_back(from + (to - from) * s / 37);
    }
    const RiskOfPath a = Measure(risk, coarse), b = Measure(risk, fine);
    EXPECT_EQ(a.visits, cells);
    EXPECT_EQ(a.cumulative_risk, sum);
    EXPECT_EQ(a.visits_of.cells, b.visits_of.cells);
    EXPECT_EQ(a.terrain_crossings, b.terrain_crossings);
    EXPECT_GE(a.cumulative_risk, a.each_cell_once);
  }
}

TEST(RiskOfPath, CoverageIsOfFreeCellsThatFloorOrTerrainLeadsTo) {
  const RiskMap risk = Numbered(R"(
      ..=..#.
      ..=..#.
      ..=..v.)");
  // Twelve of them: left and right of the strip, not behind the wall and the drop.
  EXPECT_EQ(Measure(risk, {{0.5, 0.5}}).coverage, 1.0 / 12);
  EXPECT_EQ(Measure(risk, {{0.5, 0.5}, {4.5, 0.5}}).coverage, 4.0 / 12) << "terrain is not of them";
  EXPECT_EQ(Measure(risk, {{4.5, 0.5}, {4.5, 2.5}}).coverage, 3.0 / 12);
  EXPECT_EQ(Measure(risk, {{6.5, 0.5}, {6.5, 2.5}}).coverage, 1.0) << "of what its start reaches";
  EXPECT_EQ(Measure(risk, {{2.5, 0.5}}).coverage, 0.0);
  EXPECT_EQ(MeasureRisk(risk, {}).coverage, 0.0);
}

TEST(RiskOfPath, CoverageOfAWayThatBeginsBesideItsCells) {
  // The robot starts where its cell is a wall's, too, and drives to a free one.
  const RiskMap risk = Numbered("#...\n#...\n");
  EXPECT_EQ(Measure(risk, {{0.95, 0.5}, {1.5, 0.5}, {3.5, 0.5}}).coverage, 0.5);
}

TEST(RiskOfPath, RangesHoldEachCellThatIsNoSolidOnce) {
  const RiskMap risk = testing::DrawRisk(R"(
      ....=....
      ..v.=..#.
      ....=....
      .G..=....)");
  std::vector<Vec2> points = {{0.5, 0.5}, {3.5, 0.5}, {3.5, 3.5},
                              {8.5, 3.5}, {8.5, 0.5}, {0.5, 0.5}};  // over the pane, too
  const RiskOfPath dut = Measure(risk, points);
  ASSERT_EQ(dut.ranges.size(), 10u);
  double low = 1e9, high = 0;
  int cells = 0, visits = 0;
  for (std::size_t i = 0; i < risk.rf.cells.size(); ++i) {
    if (risk.grid.contents.cells[i].solid) continue;
    low = std::min(low, risk.rf.cells[i]), high = std::max(high, risk.rf.cells[i]);
    ++cells, visits += dut.visits_of.cells[i];
  }
  EXPECT_EQ(dut.ranges.front().low, low);
  EXPECT_EQ(dut.ranges.back().high, high);
  EXPECT_GT(dut.ranges.front().cells, 0);
  EXPECT_GT(dut.ranges.back().cells, 0) << "the highest belongs to the last";
  int in_ranges = 0, visits_in_ranges = 0;
  for (std::size_t r = 0; r < dut.ranges.size(); ++r) {
    const auto& range = dut.ranges[r];
    EXPECT_NEAR(range.high - range.low, (high - low) / 10, 1e-12);
    if (r > 0) {
      EXPECT_EQ(range.low, dut.ranges[r - 1].high);
    }
    int expected = 0, expected_visits = 0;
    for (std::size_t i = 0; i < risk.rf.cells.size(); ++i) {
      const double rf = risk.rf.cells[i];
      if (risk.grid.contents.cells[i].solid || rf < range.low) continue;
      if (rf < range.high || r == 9) ++expected, expected_visits += dut.visits_of.cells[i];
    }
    EXPECT_EQ(range.cells, expected) << r;
    EXPECT_EQ(range.visits, expected_visits) << r;
    in_ranges += range.cells, visits_in_ranges += range.visits;
  }
  EXPECT_EQ(in_ranges, cells);
  EXPECT_EQ(visits_in_ranges, visits);
  EXPECT_EQ(dut.visits_of(1, 0), 2);
  EXPECT_EQ(dut.visits, visits + 2) << "the pane's are in no range";
}

TEST(RiskOfPath, ExistsWhereAllRiskIsTheSameAndWhereNothingIsFree) {
  const RiskOfPath flat = Measure(testing::DrawRisk("...\n"), {{0.5, 0.5}, {2.5, 0.5}});
  EXPECT_EQ(flat.cumulative_risk, 0);
  ASSERT_EQ(flat.ranges.size(), 10u);
  EXPECT_EQ(flat.ranges[0].cells, 3);
  EXPECT_EQ(flat.ranges[0].visits, 3);
  EXPECT_TRUE(Measure(testing::DrawRisk("v#\n"), {{0.5, 0.5}}).ranges.empty());
}

}  // namespace
}  // namespace floorproof
