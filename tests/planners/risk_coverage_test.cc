// SPDX-License-Identifier: Apache-2.0
// What risk_coverage adds to the walk that it searches: over which cells it goes, and how it
// crosses terrain.
#include <gtest/gtest.h>

#include <set>

#include "planners/risk/risk_meter.h"
#include "planners/risk/terrain_yaw.h"
#include "tests/planners/risk_floors.h"

namespace floorproof {
namespace {

using testing::DrawHazards;
using testing::MakePlanner;
using testing::PaperTables;
using testing::SquareRobot;

// A square robot as wide as a cell that moves every way; better forward, as hTetro.
RobotSpec Square() {
  RobotSpec robot = SquareRobot(0.5);
  robot.max_speed_mps = 0.4;
  robot.cover_forward_rad = 0.7;
  robot.cover_sideways_rad = 0.6;
  robot.cover_speed_mps = 0.3;
  return robot;
}

struct Planned {
  HazardMap map;
  RiskMap risk;
  PlanResult plan;
};
Planned Plan(const std::string& floor, const RobotSpec& robot, const Vec2& start, const Vec2& goal,
             const std::string& planner = "risk_coverage", const std::string& params = "{}") {
  Planned out{DrawHazards(floor, 0.5), {}, {}};
  out.risk = ComputeRisk(out.map, robot, PaperTables());
  out.plan = MakePlanner(planner, params)
                 ->Plan({out.map, robot, {start.x(), start.y(), 0}, goal, 0, &out.risk});
  EXPECT_EQ(out.plan.status, PlanStatus::kSuccess) << out.plan.message;
  return out;
}

const char* kAcrossX = R"(
    .......=...
    .......=...
    .......=...
    .......=...
    .......=...)";
const char* kAcrossY = R"(
    .......
    .......
    .......
    =======
    .......
    .......
    .......)";

// The legs that lead onto terrain.
std::vector<std::size_t> LegsOntoTerrain(const Planned& p) {
  std::vector<std::size_t> legs;
  for (std::size_t i = 1; i < p.plan.path.size(); ++i) {
    const Vec2 a = p.plan.path[i - 1].p_W, b = p.plan.path[i].p_W;
    for (double s = 0; s <= 1; s += 0.01) {
      const Cell cell = p.risk.grid.frame.ToCell(a + s * (b - a));
      if (!p.risk.grid.contents(cell).terrain()) continue;
      legs.push_back(i);
      break;
    }
  }
  return legs;
}

TEST(RiskCoverage, CrossesAStripOnceSquarelyFastAndForward) {
  for (const char* floor : {kAcrossX, kAcrossY}) {
    const bool along_y = floor == kAcrossY;
    const Planned dut =
        Plan(floor, Square(), {0.25, 0.25}, along_y ? Vec2(3.25, 3.25) : Vec2(5.25, 2.25));
    const RiskOfPath measured = MeasureRisk(dut.risk, dut.plan.path);
    EXPECT_EQ(measured.terrain_crossings, 1);
    EXPECT_EQ(measured.coverage, 1);
    const std::vector<std::size_t> legs = LegsOntoTerrain(dut);
    ASSERT_EQ(legs.size(), 1u);
    const Waypoint &from = dut.plan.path[legs[0] - 1], &to = dut.plan.path[legs[0]];
    const Vec2 way = to.p_W - from.p_W;
    EXPECT_NEAR(way[along_y ? 0 : 1], 0, 1e-9);
    EXPECT_NEAR(std::abs(way.normalized().dot(Vec2(std::cos(*to.yaw_rad), std::sin(*to.yaw_rad)))),
                1, 1e-9)
        << "forward, or backwards";
    EXPECT_EQ(to.speed_mps, 0.3);
  }
}

TEST(RiskCoverage, ARobotThatSaysNothingOfCoversKeepsItsYawAndSpeed) {
  RobotSpec robot = Square();
  robot.cover_forward_rad = robot.cover_sideways_rad = robot.cover_speed_mps = 0;
  for (const Waypoint& w : Plan(kAcrossY, robot, {0.25, 0.25}, {3.25, 3.25}).plan.path) {
    EXPECT_EQ(w.yaw_rad, 0);
    EXPECT_EQ(w.speed_mps, 0);
  }
}

TEST(RiskCoverage, CrossesAwayFromWallsWhereThatCostsLittle) {
  for (const char* params : {"{}", "{risk_share: 0}", "{risk_share: 1}"}) {
    const Planned dut =
        Plan(kAcrossX, Square(), {0.25, 0.25}, {5.25, 2.25}, "risk_coverage", params);
    const std::vector<std::size_t> legs = LegsOntoTerrain(dut);
    ASSERT_EQ(legs.size(), 1u);
    const double y = dut.plan.path[legs[0]].p_W.y();
    EXPECT_GT(y, 0.5) << params;
    EXPECT_LT(y, 2.0) << params;
  }
}

TEST(RiskCoverage, OverThePapersCellsItVisitsTheSameOnes) {
  const char* floor = R"(
    ...........
    ...##......
    .......=...
    ..#....=.#.
    ...........
    ........##.
    ...........)";
  const Planned paper = Plan(floor, Square(), {0.25, 0.25}, {5.25, 3.25}, "fmea_path_transform");
  const Planned ours =
      Plan(floor, Square(), {0.25, 0.25}, {5.25, 3.25}, "risk_coverage", "{cells: fmea}");
  const auto cells = [](const Planned& p) {
    std::set<std::size_t> visited;
    const RiskOfPath measured = MeasureRisk(p.risk, p.plan.path);
    for (std::size_t i = 0; i < measured.visits_of.cells.size(); ++i)
      if (measured.visits_of.cells[i] > 0) visited.insert(i);
    return visited;
  };
  EXPECT_EQ(cells(paper), cells(ours));
  EXPECT_LE(MeasureRisk(ours.risk, ours.plan.path).cumulative_risk,
            MeasureRisk(paper.risk, paper.plan.path).cumulative_risk);
}

RiskGrid GridOf(const std::string& floor) {
  return MakeRiskGrid(DrawHazards(floor, 0.5), Square(), PaperTables(), std::nullopt);
}

TEST(TerrainYaw, TurnsWhereTheWayBendsBehindTheTerrainBefore) {
  const RiskGrid grid = GridOf(R"(
      .....
      =====
      .....
      .....)");
  // Along the second row from below, then up over the strip.
  const std::vector<Cell> tour = {{0, 1}, {1, 1}, {2, 1}, {2, 2}, {2, 3}};
  EXPECT_EQ(QuartersOverTerrain(grid, tour, 0, TerrainLead::kForward),
            (std::vector<int>{0, 0, 0, 1, 1}));
  EXPECT_EQ(QuartersOverTerrain(grid, tour, 1, TerrainLead::kForward),
            (std::vector<int>{1, 1, 1, 1, 1}));
}

TEST(TerrainYaw, CrossesAsItIsWhereThereIsNoRoomToTurn) {
  const RiskGrid grid = GridOf(R"(
      #.#
      #=#
      #.#
      #.#)");
  const std::vector<Cell> tour = {{1, 0}, {1, 1}, {1, 2}, {1, 3}};
  EXPECT_EQ(QuartersOverTerrain(grid, tour, 0, TerrainLead::kForward),
            (std::vector<int>{0, 0, 0, 0}));
}

TEST(TerrainYaw, TurnsBackForTerrainThatLiesTheOtherWay) {
  const RiskGrid grid = GridOf(R"(
      .......
      ===....
      .....=.
      .....=.
      .....=.)");
  const std::vector<Cell> tour = {{1, 1}, {1, 2}, {1, 3}, {1, 4}, {2, 4}, {3, 4},
                                  {3, 3}, {3, 2}, {3, 1}, {4, 1}, {5, 1}, {6, 1}};
  const std::vector<int> dut = QuartersOverTerrain(grid, tour, 0, TerrainLead::kForward);
  EXPECT_EQ(dut[3], 1);
  EXPECT_EQ(dut[10] % 2, 0);
}

}  // namespace
}  // namespace floorproof
