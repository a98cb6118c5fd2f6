// SPDX-License-Identifier: Apache-2.0
// What every registered planner promises, on floors drawn here and, where they are available, on a
// real map. Planners of lines sweep 95 % of what the robot can. Planners by risk go from cell to
// cell of the robot's width, and visit each free cell that can be reached, except those that they
// say they leave out.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <ostream>
#include <string>
#include <tuple>

#include "env/map/site.h"
#include "planners/lines/coverage_planner.h"
#include "tests/planners/risk_floors.h"

namespace floorproof {
namespace {

using testing::Coverage;
using testing::DiscRobot;
using testing::Draw;
using testing::ExpectSound;
using testing::MakePlanner;
using testing::PaperTables;

double Figure(const PlanResult& plan, const std::string& name) {
  for (const auto& [key, value] : plan.figures)
    if (key == name) return value;
  return 0;
}

// What the planner promises to cover.
void ExpectCovered(const Planner& planner, const PlanRequest& request, const PlanResult& plan) {
  if (dynamic_cast<const CoveragePlanner*>(&planner) != nullptr) {
    EXPECT_GE(Coverage(request.map, request.robot, request.start, plan), 0.95);
    return;
  }
  const RiskOfPath measured = MeasureRisk(*request.risk, plan.path);
  const RiskGrid& grid = request.risk->grid;
  Grid<std::uint8_t> drivable(grid.cells.width, grid.cells.height);
  for (std::size_t i = 0; i < drivable.cells.size(); ++i)
    drivable.cells[i] = !grid.cells.cells[i].solid;
  const Grid<std::int32_t> steps = StepsFrom(drivable, grid.frame.ToCell(request.start.p()));
  int free = 0, missed = 0;
  for (std::size_t i = 0; i < drivable.cells.size(); ++i) {
    if (!grid.cells.cells[i].free() || steps.cells[i] < 0) continue;
    ++free;
    missed += measured.visits_of.cells[i] == 0;
  }
  EXPECT_GT(free, 0);
  EXPECT_NEAR(measured.coverage, 1 - static_cast<double>(missed) / free, 1e-12);
  EXPECT_EQ(missed, Figure(plan, "high_risk_cells") + Figure(plan, "cut_off_cells"));
  EXPECT_GE(measured.coverage, 0.8);
}

struct Drawing {
  const char* name;
  const char* rows;
  double cell_m;
  Pose2 X_WG;
  Cell start;
};

const Drawing kFloors[] = {
    {"one_room",
     R"(
      ############
      #..........#
      #..........#
      #..........#
      #..........#
      ############)",
     0.5,
     {},
     {1, 1}},
    {"pillar",
     R"(
      .........
      .........
      ...##....
      ...##....
      .........
      .........)",
     0.5,
     {},
     {0, 0}},
    {"two_rooms_and_a_door",
     R"(
      ...........
      ....#......
      ....#......
      ....#......
      ....#......)",
     0.5,
     {-3, 7, 0.7},
     {8, 2}},
    {"corridor",
     R"(
      #################
      ................#
      ###############.#
      #...............#
      #.###############
      #................
      #################)",
     0.6,
     {},
     {0, 5}},
    {"comb",
     R"(
      #.#.#.#.#.#
      #.#.#.#.#.#
      #.#.#.#.#.#
      ...........)",
     0.5,
     {1, 1, -2.2},
     {5, 0}},
    {"specks",
     R"(
      ....................
      ...#......#.........
      .........#.....#....
      ..#.................
      ............#.......
      .....#..............
      ..........#......#..
      ....................
      ...#.......#........
      ....................)",
     0.2,
     {},
     {1, 1}},
    {"unknown_around",
     R"(
      ????????????
      ??......????
      ??.........?
      ??......????
      ????????????)",
     0.5,
     {},
     {4, 2}},
    {"one_cell",
     R"(
      ###
      #.#
      ###)",
     0.5,
     {},
     {1, 1}},
};

void PrintTo(const Drawing& drawing, std::ostream* out) { *out << drawing.name; }

using Case = std::tuple<std::string, Drawing>;

class EveryPlanner : public ::testing::TestWithParam<Case> {
 protected:
  std::unique_ptr<Planner> dut_ = MakePlanner(std::get<0>(GetParam()));
  HazardMap map_ = Draw(std::get<1>(GetParam()).rows, std::get<1>(GetParam()).cell_m,
                        std::get<1>(GetParam()).X_WG);
  Pose2 start_ = {map_.frame.Center(std::get<1>(GetParam()).start).x(),
                  map_.frame.Center(std::get<1>(GetParam()).start).y(), 0};
  RobotSpec robot_ = DiscRobot(0.18, 0.3);

  PlanResult Plan() {
    risk_ = ComputeRisk(map_, robot_, PaperTables());
    return dut_->Plan(Request());
  }
  PlanRequest Request() const { return {map_, robot_, start_, std::nullopt, 7, &risk_}; }
  RiskMap risk_;
};

TEST_P(EveryPlanner, CoversTheFloorOrSaysWhy) {
  const PlanResult plan = Plan();
  if (plan.status != PlanStatus::kSuccess) {
    EXPECT_FALSE(plan.message.empty());
    return;
  }
  EXPECT_TRUE(plan.message.empty() || plan.message.starts_with("left out")) << plan.message;
  ExpectCovered(*dut_, Request(), plan);
}

TEST_P(EveryPlanner, KeepsItsClearShapeOffEveryWall) { ExpectSound(map_, start_, Plan()); }

TEST_P(EveryPlanner, SaysWithWhatItPlanned) {
  const PlanResult plan = Plan();
  EXPECT_EQ(plan.clear.radius_m, robot_.clear.radius_m);
  EXPECT_EQ(plan.tool.radius_m, robot_.tool.radius_m);
  EXPECT_EQ(plan.tool_width_m, robot_.tool_width_m);
}

TEST_P(EveryPlanner, SameSeedSamePath) {
  const PlanResult a = Plan(), b = Plan();
  ASSERT_EQ(a.path.size(), b.path.size());
  for (std::size_t i = 0; i < a.path.size(); ++i) EXPECT_EQ(a.path[i].p_W, b.path[i].p_W);
}

TEST_P(EveryPlanner, HasNoPointsWithoutNeed) {
  const Path path = Plan().path;
  for (std::size_t i = 1; i < path.size(); ++i)
    EXPECT_GT((path[i].p_W - path[i - 1].p_W).norm(), 1e-6) << i;
  for (std::size_t i = 2; i < path.size(); ++i)
    EXPECT_GT(DistanceToSegment(path[i - 2].p_W, path[i].p_W, path[i - 1].p_W), 1e-6) << i;
}

TEST_P(EveryPlanner, RefusesAStartWhereTheRobotDoesNotFit) {
  for (const Vec2& p :
       {Vec2(map_.frame.X_WG * Vec2(-1, -1)),
        Vec2(map_.frame.X_WG * Vec2(map_.frame.cell_m * map_.frame.width - 0.05,
                                    map_.frame.cell_m * map_.frame.height - 0.05))}) {
    start_ = {p.x(), p.y(), 0};
    const PlanResult plan = Plan();
    EXPECT_EQ(plan.status, PlanStatus::kStartBlocked);
    EXPECT_TRUE(plan.path.empty());
    const Cell cell = map_.frame.ToCell(p);
    EXPECT_NE(plan.message.find("cell (" + std::to_string(cell.ix) + ", " +
                                std::to_string(cell.iy) + ")"),
              std::string::npos)
        << plan.message;
  }
}

TEST_P(EveryPlanner, RefusesARobotThatFitsNowhere) {
  robot_ = DiscRobot(30, 1);
  EXPECT_EQ(Plan().status, PlanStatus::kStartBlocked);
}

TEST_P(EveryPlanner, AMirroredFloorCostsTheSame) {
  const PlanResult plan = Plan();
  const double coverage = Coverage(map_, robot_, start_, plan);
  const Vec2 p = map_.frame.X_WG.Inverse() * start_.p();
  const Vec2 q = map_.frame.X_WG * Vec2(map_.frame.width * map_.frame.cell_m - p.x(), p.y());
  map_ = testing::Mirrored(map_);
  start_ = {q.x(), q.y(), 0};
  const PlanResult mirrored = Plan();
  EXPECT_NEAR(Coverage(map_, robot_, start_, mirrored), coverage, 0.05);
  EXPECT_NEAR(Length(mirrored.path), Length(plan.path), 0.2 * Length(plan.path) + 0.5);
}

std::vector<Case> Cases() {
  std::vector<Case> cases;
  for (const auto& planner : Planners())
    for (const Drawing& floor : kFloors) cases.emplace_back(std::string(planner.name), floor);
  return cases;
}

INSTANTIATE_TEST_SUITE_P(Planners, EveryPlanner, ::testing::ValuesIn(Cases()),
                         [](const auto& param_info) {
                           return std::get<0>(param_info.param) + "_" +
                                  std::get<1>(param_info.param).name;
                         });

class EveryPlannerOnSites : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryPlannerOnSites, KeepsOffKnownHazardsItCannotCross) {
  const Site site = ReadSite(ParseYaml(R"(
site: 1
name: hall
grid:
  cell_m: 0.5
  rows: |
    #############
    #...=...#...#
    #.G.=.v.#.r.#
    #...=.......#
    #..##...g...#
    #...........#
    #############
hazards:
  - {type: glass, line_m: [[3.0, 0.9], [3.0, 1.4]], height_m: 1.0, thickness_m: 0.01, restitution: 0.3}
)",
                                       "hall.yaml"),
                             ".");
  const RobotSpec robot = DiscRobot(0.2, 0.3);
  const Pose2 start{0.75, 0.75, 0};
  const RiskMap risk = ComputeRisk(site.map, robot, PaperTables());
  const PlanRequest request{site.map, robot, start, std::nullopt, 7, &risk};
  const auto dut = MakePlanner(GetParam());
  const PlanResult plan = dut->Plan(request);
  ExpectSound(site.map, start, plan);
  ExpectCovered(*dut, request, plan);
  // Independent of the walls' ruler: distance from the path to each obstacle's polygon.
  int obstacles = 0;
  for (const Hazard& hazard : site.map.hazards) {
    if (!IsObstacle(hazard, robot.step_m)) continue;
    ++obstacles;
    for (std::size_t i = 1; i < plan.path.size(); ++i)
      for (int s = 0; s <= 50; ++s) {
        const Vec2 p = plan.path[i - 1].p_W + (plan.path[i].p_W - plan.path[i - 1].p_W) * s / 50;
        for (const Polygon& polygon : hazard.footprint)
          ASSERT_GE(SignedDistance(polygon, p), robot.clear.radius_m - 0.025) << hazard.id;
      }
  }
  EXPECT_EQ(obstacles, 3);  // two panes and a drop; not the cable cover, the groove, the rough
}

TEST_P(EveryPlannerOnSites, CoversARealMap) {
  const std::filesystem::path yaml =
      std::filesystem::path(FP_SHARED_MAPS_DIR) / "lab_small/map.yaml";
  if (!std::filesystem::exists(yaml)) GTEST_SKIP() << "no shared maps here";
  const RosMap ros = ReadRosMap(yaml);
  HazardMap map;
  map.frame = ros.frame;
  map.cells = ros.cells;
  const ClearanceField clearance = ComputeClearance(map, 0.01);  // start amid the widest place
  const auto widest =
      std::max_element(clearance.distance_m.cells.begin(), clearance.distance_m.cells.end()) -
      clearance.distance_m.cells.begin();
  const Vec2 p = clearance.frame.Center(static_cast<int>(widest) % clearance.frame.width,
                                        static_cast<int>(widest) / clearance.frame.width);
  const Pose2 start{p.x(), p.y(), 0};
  for (const bool wide : {false, true}) {
    const RobotSpec robot = wide ? DiscRobot(0.35, 0.5) : DiscRobot(0.18, 0.3);
    const RiskMap risk = ComputeRisk(map, robot, PaperTables());
    const PlanRequest request{map, robot, start, std::nullopt, 7, &risk};
    const auto dut = MakePlanner(GetParam());
    const PlanResult plan = dut->Plan(request);
    ExpectSound(map, start, plan);
    ExpectCovered(*dut, request, plan);
  }
}

INSTANTIATE_TEST_SUITE_P(Planners, EveryPlannerOnSites,
                         ::testing::ValuesIn(PluginNames(Planners())));

}  // namespace
}  // namespace floorproof
