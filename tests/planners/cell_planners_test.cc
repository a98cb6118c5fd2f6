// SPDX-License-Identifier: Apache-2.0
// What all planners that go from cell to cell have in common, seen from outside. That each covers
// what it promises is in tests/conformance/planners_test.cc.
#include <gmock/gmock.h>

#include "base/streams.h"
#include "tests/planners/cell_site.h"

namespace floorproof {
namespace {

using ::testing::AllOf;
using testing::DiscRobot;
using testing::DrawHazards;
using testing::EmptyFloor;
using testing::Figure;
using ::testing::HasSubstr;
using testing::MakePlanner;
using testing::Site;
using testing::SquareRobot;

class CellPlanners : public ::testing::TestWithParam<std::string> {
 protected:
  void ExpectRefused(const Site& site, const PlanResult& plan, PlanStatus status,
                     const std::string& cell, const std::string& why) const {
    EXPECT_EQ(plan.status, status) << plan.message;
    EXPECT_TRUE(plan.path.empty());
    EXPECT_THAT(plan.message, AllOf(HasSubstr("cell " + cell), HasSubstr(why)));
    EXPECT_EQ(plan.message.find('\n'), std::string::npos);
    EXPECT_EQ(plan.clear.footprint_B, site.robot.clear.footprint_B) << "said all the same";
  }
};
INSTANTIATE_TEST_SUITE_P(Planners, CellPlanners,
                         ::testing::Values("path_transform", "fmea_path_transform",
                                           "risk_coverage"),
                         [](const auto& param_info) { return param_info.param; });

TEST_P(CellPlanners, NeedTheRisk) {
  const Site site("...\n");
  const PlanResult plan =
      MakePlanner(GetParam())
          ->Plan({site.map, site.robot, {0.25, 0.25, 0}, std::nullopt, 1, nullptr});
  EXPECT_EQ(plan.status, PlanStatus::kFailed);
  EXPECT_THAT(plan.message, HasSubstr("risk"));
  EXPECT_TRUE(plan.path.empty());
}

TEST_P(CellPlanners, AStartOnAHazardNamesItsCell) {
  const Site site("......\n.#Gv=.\n......\n");
  const auto refused = [&](Cell start, const std::string& why) {
    ExpectRefused(site, site.Plan(GetParam(), start), PlanStatus::kStartBlocked,
                  "(" + std::to_string(start.ix) + ", 1)", why);
  };
  refused({1, 1}, "(C1)");
  refused({2, 1}, "(C2)");
  refused({3, 1}, "(C3)");
  refused({4, 1}, "(C4)");
}

TEST_P(CellPlanners, AStartOnAStepThatTheRobotManagesIsOnAHazardToo) {
  Site site("......\n...v..\n......\n");
  site.map.hazards[0].height_m = 0.005;
  ASSERT_FALSE(IsObstacle(site.map.hazards[0], site.robot.step_m));
  ExpectRefused(site, site.Plan(GetParam(), Cell{3, 1}), PlanStatus::kStartBlocked, "(3, 1)",
                "(C3)");
}

TEST_P(CellPlanners, ASiteWithoutAFreeCellNamesTheStarts) {
  for (const std::string rows : {"###\n###\n###\n", "=v=\n=G=\n===\n", "???\n???\n???\n"}) {
    const Site site(rows);
    ExpectRefused(site, site.Plan(GetParam(), Cell{1, 1}), PlanStatus::kStartBlocked, "(1, 1)", "");
  }
}

TEST_P(CellPlanners, AStartOffTheMapOrTooNearAWallNamesItsCell) {
  const Site site("....\n....\n..#.\n");
  ExpectRefused(site, site.Plan(GetParam(), Vec2(-0.1, 0.25)), PlanStatus::kStartBlocked, "(-1, 0)",
                "off the map");
  ExpectRefused(site, site.Plan(GetParam(), Vec2(0.25, 99)), PlanStatus::kStartBlocked, "(0, 198)",
                "off the map");
  ExpectRefused(site, site.Plan(GetParam(), Vec2(0.85, 0.25)), PlanStatus::kStartBlocked, "(1, 0)",
                "does not fit");
}

TEST_P(CellPlanners, AStartOnTheMapsVeryEdgeIsRefused) {
  // Three cells of the robot's width in each of the map's: 0.9 * 5 and 0.3 * 15 are two numbers.
  const Site site(EmptyFloor(5, 5, 0.9), SquareRobot(0.3));
  const double edge = std::nextafter(0.9 * 5, 0.0);
  EXPECT_EQ(site.Plan(GetParam(), Vec2(edge, edge)).status, PlanStatus::kStartBlocked);
  EXPECT_EQ(site.Plan(GetParam(), Vec2(0, 0)).status, PlanStatus::kStartBlocked);
}

TEST_P(CellPlanners, AGoalThatCannotBeReachedNamesItsCell) {
  const Site site(R"(
      ...#.....
      ...#.....
      ####.....
      .....=..v)");
  const auto refused = [&](Cell goal, const std::string& cell, const std::string& why) {
    ExpectRefused(site, site.Plan(GetParam(), Cell{4, 3}, goal, "{unreachable_share: 1}"),
                  PlanStatus::kGoalUnreachable, cell, why);
  };
  refused({1, 3}, "(1, 3)", "neither floor nor terrain");
  refused({3, 3}, "(3, 3)", "(C1)");
  refused({8, 0}, "(8, 0)", "(C3)");
  refused({5, 0}, "(5, 0)", "(C4)");
  refused({9, 0}, "(9, 0)", "off the map");
  EXPECT_EQ(site.Plan(GetParam(), Cell{4, 3}, Cell{0, 0}, "{unreachable_share: 1}").status,
            PlanStatus::kSuccess);
}

TEST_P(CellPlanners, AFloorThatFallsApartNamesACellBeyond) {
  for (const std::string bar : {"#", "v", "G"}) {
    std::string rows;
    for (int i = 0; i < 4; ++i) rows += "..=.." + bar + "..=..\n";
    const Site site(rows);
    const PlanResult plan = site.Plan(GetParam(), Cell{0, 0});
    ExpectRefused(site, plan, PlanStatus::kFloorDivided, "(6, 0)", "falls apart");
    EXPECT_THAT(plan.message, HasSubstr("(3.25, 0.25) m"));
    EXPECT_EQ(site.Plan(GetParam(), Cell{0, 0}, {}, "{unreachable_share: 0.5}").status,
              PlanStatus::kSuccess);
    EXPECT_EQ(site.Plan(GetParam(), Cell{0, 0}, {}, "{unreachable_share: 0.49}").status,
              PlanStatus::kFloorDivided);
  }
}

TEST_P(CellPlanners, AFewCellsOutOfReachAreLeftOut) {
  const Site site(R"(
      .......#.
      .......##
      .........
      .........
      .........)");
  const PlanResult plan = site.Plan(GetParam(), Cell{0, 0});
  ASSERT_EQ(plan.status, PlanStatus::kSuccess) << plan.message;
  EXPECT_EQ(Figure(plan, "unreachable_cells"), 1);
  EXPECT_THAT(plan.message, HasSubstr("left out"));
  EXPECT_THAT(plan.message, HasSubstr("cell (8, 4) of 0.5 m"));
  EXPECT_EQ(site.Plan(GetParam(), Cell{0, 0}, {}, "{unreachable_share: 0}").status,
            PlanStatus::kFloorDivided);
  EXPECT_EQ(site.Measure(plan).visits_of(8, 4), 0);
}

TEST_P(CellPlanners, CellsThatTheRobotIsTooWideForAreRefused) {
  RiskParams params;
  params.cell_m = 0.25;
  const Site site(DrawHazards("......\n......\n...#..\n......\n", 0.5), SquareRobot(0.5), params);
  ASSERT_EQ(site.risk.grid.frame.cell_m, 0.25);
  const PlanResult plan = site.Plan(GetParam(), Vec2(0.5, 0.5));
  EXPECT_EQ(plan.status, PlanStatus::kFailed);
  EXPECT_THAT(plan.message, AllOf(HasSubstr("0.25"), HasSubstr("0.5")));
  EXPECT_TRUE(plan.path.empty());
}

TEST_P(CellPlanners, ThePathRunsFromStartToGoalThroughTheirCells) {
  Site site(DrawHazards("........\n........\n........\n........\n", 0.5), SquareRobot(0.4));
  const Vec2 start(0.29, 0.22), goal(2.71, 1.3);
  const PlanResult plan = site.Plan(GetParam(), start, goal);
  ASSERT_EQ(plan.status, PlanStatus::kSuccess) << plan.message;
  EXPECT_EQ(plan.path.front().p_W, start);
  EXPECT_LT((plan.path[1].p_W - site.At({0, 0})).norm(), 1e-9);
  EXPECT_EQ(plan.path.back().p_W, goal);
  EXPECT_LT((plan.path[plan.path.size() - 2].p_W - site.At({5, 2})).norm(), 1e-9);
  const RiskOfPath measured = site.Measure(plan);
  EXPECT_EQ(measured.cells, 32);
  EXPECT_EQ(measured.coverage, 1);
}

TEST_P(CellPlanners, WithoutAGoalItEndsFarthestFromTheStart) {
  const Site site("....#\n###.#\n.....\n.###=\n");
  const PlanResult plan = site.Plan(GetParam(), Cell{0, 3});
  ASSERT_EQ(plan.status, PlanStatus::kSuccess) << plan.message;
  EXPECT_LT((plan.path.back().p_W - site.At({0, 0})).norm(), 1e-9);
  // Terrain is farther, yet no place to stay.
  const Site strip(".....=\n");
  EXPECT_LT((strip.Plan(GetParam(), Cell{0, 0}).path.back().p_W - strip.At({4, 0})).norm(), 1e-9);
}

TEST_P(CellPlanners, OneFreeCellIsAPlan) {
  const Site site("###\n#.#\n###\n");
  const PlanResult plan = site.Plan(GetParam(), Cell{1, 1});
  ASSERT_EQ(plan.status, PlanStatus::kSuccess) << plan.message;
  ASSERT_EQ(plan.path.size(), 1u);
  EXPECT_EQ(site.Measure(plan).coverage, 1);
}

TEST_P(CellPlanners, ARobotThatMovesEveryWayHoldsAQuarterTurnOfTheMap) {
  HazardMap map = DrawHazards("....\n....\n", 0.5, {1, 2, 0.3});
  for (const auto& [start_yaw, yaw] :
       {std::pair(0.0, 0.3), std::pair(1.2, 0.3 + kPi / 2), std::pair(-1.0, 0.3 - kPi / 2),
        std::pair(-2.8, 0.3 - kPi), std::pair(0.3, 0.3)}) {
    const Site site(map, SquareRobot(0.5));
    const Vec2 p = site.At({0, 0});
    const PlanResult plan =
        MakePlanner(GetParam())
            ->Plan({site.map, site.robot, {p.x(), p.y(), start_yaw}, std::nullopt, 1, &site.risk});
    ASSERT_EQ(plan.status, PlanStatus::kSuccess) << plan.message;
    for (const Waypoint& waypoint : plan.path) {
      ASSERT_TRUE(waypoint.yaw_rad.has_value());
      EXPECT_NEAR(WrapAngle(*waypoint.yaw_rad - yaw), 0, 1e-12);
    }
    const Site disc(map, DiscRobot(0.25, 0.5));
    for (const Waypoint& waypoint : disc.Plan(GetParam(), Cell{0, 0}).path)
      EXPECT_FALSE(waypoint.yaw_rad.has_value());
  }
}

// A footprint to keep clear makes no robot drive sideways.
TEST_P(CellPlanners, ARobotThatCannotGoSidewaysHoldsNoHeading) {
  Site site("......\n......\n......\n");
  site.robot.wheels.back().roller_angle_rad = 0;
  const PlanResult plan = site.Plan(GetParam(), Cell{0, 0});
  ASSERT_EQ(plan.status, PlanStatus::kSuccess) << plan.message;
  for (const Waypoint& w : plan.path) EXPECT_FALSE(w.yaw_rad.has_value());
}

TEST_P(CellPlanners, StartsFromWhereverItFitsOnAFineMap) {
  // Rooms of 0.05 m cells with specks; the start is anywhere that the robot fits, off the lattice.
  Stream random(1, 0, GetParam());
  int planned = 0, off = 0;
  for (int round = 0; round < 200; ++round) {
    HazardMap map = EmptyFloor(70, 60, 0.05);
    for (int i = 0; i < 20; ++i)
      map.occupancy(static_cast<int>(random.Below(70)), static_cast<int>(random.Below(60))) =
          CellState::kOccupied;
    const bool square = round % 2 == 0;
    const Site site(map, square ? SquareRobot(0.5) : DiscRobot(0.18, 0.3));
    const double reach = square ? 0.25 : 0.18;
    // How deep the robot at p stands in a wall, m.
    const auto depth = [&](const Vec2& p) {
      double deepest = 0;
      const Cell at = map.frame.ToCell(p);
      for (int iy = at.iy - 6; iy <= at.iy + 6; ++iy)
        for (int ix = at.ix - 6; ix <= at.ix + 6; ++ix) {
          if (!map.IsWall(ix, iy)) continue;
          const double dx = std::max({0.0, ix * 0.05 - p.x(), p.x() - (ix + 1) * 0.05});
          const double dy = std::max({0.0, iy * 0.05 - p.y(), p.y() - (iy + 1) * 0.05});
          deepest = std::max(deepest, reach - (square ? std::max(dx, dy) : std::hypot(dx, dy)));
        }
      return deepest;
    };
    Vec2 start;
    do {
      start = {random.Uniform(0, 3.5), random.Uniform(0, 3)};
    } while (depth(start) > 0);
    const PlanResult plan =
        site.Plan(GetParam(), start, {},
                  GetParam() == "risk_coverage" ? "{unreachable_share: 1, effort: 0}"
                                                : "{unreachable_share: 1}");
    if (plan.status != PlanStatus::kSuccess) {
      EXPECT_EQ(plan.status, PlanStatus::kStartBlocked);  // it fits, but has no room to leave
      continue;
    }
    ++planned;
    off += !site.risk.grid.contents(site.risk.grid.frame.ToCell(start)).free();
    EXPECT_EQ(plan.path.front().p_W, start);
    for (std::size_t i = 1; i < plan.path.size(); ++i)
      for (int s = 0; s <= 100; ++s) {
        const Vec2 p = plan.path[i - 1].p_W + (plan.path[i].p_W - plan.path[i - 1].p_W) * s / 100;
        ASSERT_LE(depth(p), 0.05 / 2 + 1e-9)
            << "round " << round << ", segment " << i << " at " << p.transpose();
      }
  }
  EXPECT_GT(planned, 180);
  EXPECT_GT(off, 10);
}

TEST_P(CellPlanners, ALargeFloorEnds) {
  Stream random(2, 0, "large");
  std::string rows;
  for (int iy = 0; iy < 200; ++iy) {
    for (int ix = 0; ix < 200; ++ix) {
      const double u = random.Uniform();
      const bool strip = ix == 100;
      rows += strip ? '=' : u < 0.03 ? '#' : u < 0.035 ? 'v' : u < 0.0375 ? 'G' : '.';
    }
    rows += '\n';
  }
  rows[rows.size() - 201] = '.';  // (0, 0)
  const Site site(rows);
  const PlanResult plan = site.Plan(GetParam(), Cell{0, 0});
  ASSERT_EQ(plan.status, PlanStatus::kSuccess) << plan.message;
  const RiskOfPath measured = site.Measure(plan);
  EXPECT_GE(measured.coverage, GetParam() == "fmea_path_transform" ? 0.8 : 1.0);
  for (std::size_t i = 0; i < measured.visits_of.cells.size(); ++i) {
    if (site.risk.grid.contents.cells[i].solid) {
      ASSERT_EQ(measured.visits_of.cells[i], 0) << i;
    }
  }
}

}  // namespace
}  // namespace floorproof
