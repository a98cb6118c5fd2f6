// SPDX-License-Identifier: Apache-2.0
// What every registered planner promises (PlannerPromises), on floors drawn here, for every
// registered robot and, where they are at hand, on real maps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <ostream>
#include <string>
#include <tuple>
#include <utility>

#include "env/map/site.h"
#include "env/scene/robot_model.h"
#include "planners/lines/turned_plan.h"
#include "tests/places.h"
#include "tests/planners/curvature.h"
#include "tests/planners/planted_rates.h"
#include "tests/planners/risk_floors.h"
#include "tests/robots.h"

namespace floorproof {
namespace {

using testing::Coverage;
using testing::DiscRobot;
using testing::Draw;
using testing::ExpectSound;
using testing::MakePlanner;
using testing::PaperTables;
using testing::TightestTurn;

// Of the free cells that can be reached over floor and terrain.
void ExpectCellsCovered(const PlanRequest& request, const PlanResult& plan, double least) {
  const RiskOfPath measured = MeasureRisk(*request.risk, plan.path);
  const RiskGrid& grid = request.risk->grid;
  const Grid<std::uint8_t> drivable = CellsThat(grid, &RiskCell::drivable);
  const Grid<std::int32_t> steps = StepsFrom(drivable, grid.frame.ToCell(request.start.p()));
  int free = 0, missed = 0;
  for (std::size_t i = 0; i < drivable.cells.size(); ++i) {
    if (!grid.contents.cells[i].free() || steps.cells[i] < 0) continue;
    ++free;
    missed += measured.visits_of.cells[i] == 0;
  }
  EXPECT_GT(free, 0);
  EXPECT_NEAR(measured.coverage, 1 - static_cast<double>(missed) / free, 1e-12);
  EXPECT_EQ(missed, plan.left_out_cells);
  EXPECT_GE(measured.coverage, least);
}

// What the planner promises to cover.
void ExpectCovered(const Planner& planner, const PlanRequest& request, const PlanResult& plan) {
  const PlannerPromises promises = planner.promises();
  switch (promises.covers) {
    case PlannerPromises::Covers::kNothing:
      return;
    case PlannerPromises::Covers::kGround:
      EXPECT_GE(Coverage(request.map, request.robot, request.start, plan), promises.least_coverage);
      return;
    case PlannerPromises::Covers::kCells:
      ExpectCellsCovered(request, plan, promises.least_coverage);
  }
}

void ExpectSamePath(const Path& a, const Path& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].p_W, b[i].p_W) << i;
    ASSERT_EQ(a[i].yaw_rad, b[i].yaw_rad) << i;
  }
}

// A planner that needs a goal is sent there; others choose for themselves.
std::optional<Vec2> GoalFor(const Planner& planner, const Vec2& there) {
  return planner.promises().needs_goal ? std::optional(there) : std::nullopt;
}

// What was measured of covers and of free floor, for planners that ask for it.
const RiskModel& Measured() {
  static const RiskModel kModel = [] {
    RiskModel model;
    KindRates floor = testing::PlantedKind(std::string(kFreeFloor), Passage::kBeside, 1e-4);
    floor.per_metre = true;
    model.kinds = {floor, testing::PlantedBy("speed_mps", false, 0.05, 0.5, 0.2, 0.01)};
    return model;
  }();
  return kModel;
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
  // The plan of the floor as it is drawn, made once for all that is asked of it.
  const PlanResult& First() {
    static std::map<std::pair<std::string, std::string>, PlanResult> plans;
    const auto& [planner, drawing] = GetParam();
    risk_ = ComputeRisk(map_, robot_, PaperTables());
    const auto [at, is_new] = plans.try_emplace({planner, drawing.name});
    if (is_new) at->second = dut_->Plan(Request());
    return at->second;
  }
  PlanRequest Request() const {
    return {map_, robot_, start_, goal_, seed_, &risk_, {}, &Measured()};
  }
  std::optional<Vec2> goal_;
  std::uint64_t seed_ = 7;
  RiskMap risk_;
};

TEST_P(EveryPlanner, CoversTheFloorOrSaysWhy) {
  const PlanResult& plan = First();
  if (plan.status != PlanStatus::kSuccess) {
    EXPECT_FALSE(plan.message.empty());
    return;
  }
  EXPECT_TRUE(plan.message.empty() || plan.message.starts_with("left out")) << plan.message;
  ExpectCovered(*dut_, Request(), plan);
}

TEST_P(EveryPlanner, KeepsItsClearShapeOffEveryWall) {
  goal_ = GoalFor(*dut_, start_ * Vec2(0.06, 0.02));  // in the smallest floor's one cell
  const PlanResult plan = Plan();
  if (plan.status == PlanStatus::kTooFewSamples) GTEST_SKIP() << plan.message;
  ExpectSound(map_, start_, plan);
}

TEST_P(EveryPlanner, SaysWithWhatItPlanned) {
  const PlanResult& plan = First();
  EXPECT_EQ(plan.clear.radius_m, robot_.clear.radius_m);
  EXPECT_EQ(plan.tool.radius_m, robot_.tool.radius_m);
  EXPECT_EQ(plan.tool_width_m, robot_.tool_width_m);
}

TEST_P(EveryPlanner, SameSeedSamePath) {
  const PlanResult& first = First();
  ExpectSamePath(Plan().path, first.path);
}

TEST_P(EveryPlanner, AnotherSeedGivesAnotherPathOnlyWhereItSaysSo) {
  if (dut_->promises().uses_seed) GTEST_SKIP() << "its path may depend on the seed";
  const Path& path = First().path;
  seed_ = 8;
  ExpectSamePath(Plan().path, path);
}

// Of the floor's risk, and of the robot's measured rates.
TEST_P(EveryPlanner, AsksForWhatItNeedsOrTakesNoNotice) {
  const PlannerPromises promises = dut_->promises();
  const PlanResult& with = First();
  const auto expect = [&](const PlanRequest& request, bool refused) {
    const PlanResult without = dut_->Plan(request);
    if (refused) {
      EXPECT_EQ(without.status, PlanStatus::kFailed);
      EXPECT_FALSE(without.message.empty());
      EXPECT_TRUE(without.path.empty());
    } else {
      EXPECT_EQ(without.status, with.status);
      ExpectSamePath(without.path, with.path);
    }
  };
  PlanRequest request = Request();
  request.model = nullptr;
  if (promises.needs_risk) expect(request, promises.needs_model);
  if (promises.needs_model) request.model = &Measured();
  request.risk = nullptr;
  expect(request, promises.needs_risk);
}

TEST_P(EveryPlanner, EndsAtTheGoalOrTakesNoNotice) {
  const PlannerPromises promises = dut_->promises();
  const PlanResult& free = First();
  if (promises.needs_goal) {
    EXPECT_NE(free.status, PlanStatus::kSuccess);
    EXPECT_FALSE(free.message.empty());
  }
  goal_ = start_.p();  // a place where the robot fits
  const PlanResult plan = Plan();
  if (!promises.ends_at_goal) {
    EXPECT_EQ(plan.status, free.status);
    ExpectSamePath(plan.path, free.path);
  } else if (plan.status == PlanStatus::kSuccess) {
    EXPECT_LT((plan.path.back().p_W - *goal_).norm(), 1e-6);
  }
}

TEST_P(EveryPlanner, HasNoPointsWithoutNeed) {
  const Path& path = First().path;
  for (std::size_t i = 1; i < path.size(); ++i)
    EXPECT_GT((path[i].p_W - path[i - 1].p_W).norm(), 1e-6) << i;
  for (std::size_t i = 2; i < path.size(); ++i) {
    if (path[i - 1].task) continue;  // which is a need
    EXPECT_GT(DistanceToSegment(path[i - 2].p_W, path[i].p_W, path[i - 1].p_W), 1e-6) << i;
  }
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

// Chance may lead another way over the mirrored floor.
TEST_P(EveryPlanner, AMirroredFloorCostsTheSame) {
  if (dut_->promises().uses_seed) GTEST_SKIP() << "its path may depend on the seed";
  const PlanResult& plan = First();
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

// A robot's clear shape where a path leads it: on any way between two waypoints at the yaw of the
// second, along the way where it states none.
double LeastRoom(const HazardMap& map, const Shape2& clear, const Path& path) {
  double least = std::numeric_limits<double>::infinity();
  const double cell = map.frame.cell_m;
  double reach = clear.radius_m;  // of the shape, from the robot's origin
  if (clear.kind != Shape2::Kind::kCircle)
    for (const Vec2& q : clear.footprint_B) reach = std::max(reach, q.norm());
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vec2 a = path[i - 1].p_W, b = path[i].p_W;
    const int samples = 1 + static_cast<int>((b - a).norm() / 0.02);
    for (int s = 0; s <= samples; ++s) {
      const Vec2 p = a + (b - a) * s / samples;
      const Pose2 X_BW =
          Pose2{p.x(), p.y(), path[i].yaw_rad.value_or(std::atan2(b.y() - a.y(), b.x() - a.x()))}
              .Inverse();
      const Cell at = map.frame.ToCell(p);
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          if (!map.IsWall(at.ix + dx, at.iy + dy)) continue;
          const Vec2 low((at.ix + dx) * cell, (at.iy + dy) * cell);  // X_WG is none here
          const Vec2 nearest = p.cwiseMax(low).cwiseMin(low + Vec2(cell, cell));
          if ((p - nearest).norm() - reach >= least) continue;  // it cannot be nearer than that
          for (double t = 0; t <= 1; t += 0.02)
            for (const Vec2& q : {Vec2(t, 0), Vec2(t, 1), Vec2(0, t), Vec2(1, t)}) {
              const Vec2 q_B = X_BW * Vec2(low + cell * q);
              least = std::min(least, clear.kind == Shape2::Kind::kCircle
                                          ? q_B.norm() - clear.radius_m
                                          : SignedDistance(clear.footprint_B, q_B));
            }
        }
    }
  }
  return least;
}

void ExpectSameShape(const Shape2& a, const Shape2& b) {
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.radius_m, b.radius_m);
  EXPECT_EQ(a.footprint_B, b.footprint_B);
}

// Every robot in its own shape, and one that folds in each other shape that is convex: a bar fits
// at one yaw where it does not at the next.
struct RobotInShape {
  std::string robot, shape;
  std::string Name() const { return shape.empty() ? robot : robot + "_" + shape; }
  RobotSpec Read() const { return ReadRobot(FindRobotFile(robot, {}), {.shape = shape}).spec; }
};
void PrintTo(const RobotInShape& robot, std::ostream* out) { *out << robot.Name(); }

constexpr std::string_view kConvexShapes[] = {"O", "I"};
std::vector<RobotInShape> RobotsInShapes() {
  std::vector<RobotInShape> robots;
  for (const std::string& name : RobotNames()) {
    const std::vector<std::string> shapes = ShapeNames(name);
    if (shapes.empty()) robots.push_back({name, ""});
    for (const std::string& shape : shapes)
      if (shape == shapes.front() || std::ranges::count(kConvexShapes, shape) > 0)
        robots.push_back({name, shape});
  }
  return robots;
}

TEST(RobotsInShapes, AreAllThatAreConvex) {
  for (const std::string& name : RobotNames())
    for (const ShapeSpec& shape : ReadRobot(FindRobotFile(name, {})).spec.shapes)
      EXPECT_EQ(std::ranges::count(kConvexShapes, shape.name) > 0, IsConvex(shape.footprint_B))
          << name << " as " << shape.name;
}

using PlannerAndRobot = std::tuple<std::string, RobotInShape>;
class EveryPlannerAndRobot : public ::testing::TestWithParam<PlannerAndRobot> {};

TEST_P(EveryPlannerAndRobot, CoversAFloorAndKeepsOffItsWalls) {
  const auto dut = MakePlanner(std::get<0>(GetParam()));
  const RobotSpec robot = std::get<1>(GetParam()).Read();
  const HazardMap map = Draw(R"(
      #######
      #.....#
      #..#..#
      #.....#
      #######)",
                             1.25);  // passages wider than any robot is long
  const RiskMap risk = ComputeRisk(map, robot, PaperTables());
  for (const double yaw_rad : {0.0, kPi / 2}) {
    SCOPED_TRACE(::testing::Message() << "start's yaw " << yaw_rad);
    const Vec2 p = map.frame.Center({1, 1});
    const Pose2 start{p.x(), p.y(), yaw_rad};
    const PlanRequest request{map, robot, start, map.frame.Center({5, 1}),
                              7,   &risk, {},    &Measured()};
    const PlanResult plan = dut->Plan(request);
    ASSERT_EQ(plan.status, PlanStatus::kSuccess) << plan.message;
    EXPECT_LT((plan.path.front().p_W - start.p()).norm(), 1e-6);
    EXPECT_GE(LeastRoom(map, robot.clear, plan.path), -FineFrame(map.frame).cell_m / 2 - 1e-9);
    ExpectSameShape(plan.clear, robot.clear);
    ExpectSameShape(plan.tool, robot.tool);
    ExpectCovered(*dut, request, plan);
  }
}

INSTANTIATE_TEST_SUITE_P(Planners, EveryPlannerAndRobot,
                         ::testing::Combine(::testing::ValuesIn(PluginNames(Planners())),
                                            ::testing::ValuesIn(RobotsInShapes())),
                         [](const auto& param_info) {
                           return std::get<0>(param_info.param) + "_" +
                                  std::get<1>(param_info.param).Name();
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
  const auto dut = MakePlanner(GetParam());
  const PlanRequest request{site.map, robot, start, GoalFor(*dut, {0.75, 2.75}),
                            7,        &risk, {},    &Measured()};
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
  const std::filesystem::path yaml = SharedFile("maps") / "lab_small/map.yaml";
  if (!std::filesystem::exists(yaml)) GTEST_SKIP() << "no shared maps here";
  const RosMap ros = ReadRosMap(yaml);
  HazardMap map;
  map.frame = ros.frame;
  map.occupancy = ros.occupancy;
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
    const auto dut = MakePlanner(GetParam());
    const PlanRequest request{map, robot, start, GoalFor(*dut, p + Vec2(0.2, 0.1)),
                              7,   &risk, {},    &Measured()};
    const PlanResult plan = dut->Plan(request);
    ExpectSound(map, start, plan);
    ExpectCovered(*dut, request, plan);
    // The same, made fit for a robot that cannot turn on the spot.
    RobotSpec steered = robot;
    steered.turn_radius_m = 0.15;
    PlanResult turned = plan;
    FitTurns({map, steered, start, std::nullopt, 7, &risk}, turned);
    ExpectSound(map, start, turned);
    EXPECT_GE(TightestTurn(turned.path), 0.99 * kTurnReserve * steered.turn_radius_m);
  }
}

INSTANTIATE_TEST_SUITE_P(Planners, EveryPlannerOnSites,
                         ::testing::ValuesIn(PluginNames(Planners())),
                         [](const auto& param_info) { return param_info.param; });

}  // namespace
}  // namespace floorproof
