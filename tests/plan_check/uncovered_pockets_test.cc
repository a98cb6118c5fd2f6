// SPDX-License-Identifier: Apache-2.0
#include "run/plan_check/uncovered_pockets.h"

#include <gmock/gmock.h>

#include <cmath>

#include "run/plan_check/plan_budget.h"
#include "run/plan_check/plan_check.h"
#include "run/scenario/floors.h"
#include "run/scenario/override.h"
#include "run/scenario/scenario.h"
#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using Why = UncoveredPocket::Why;

// Rooms of 4 x 3 m side by side, drawn in cells of 0.1 m: `door` rows of the wall between them are
// free.
std::string TwoRooms(int door_cells, const std::string& hazards = "") {
  constexpr int kWidth = 82, kHeight = 32;
  std::string rows;
  for (int y = 0; y < kHeight; ++y) {
    rows += "      ";
    for (int x = 0; x < kWidth; ++x) {
      const bool wall = x == 0 || y == 0 || x == kWidth - 1 || y == kHeight - 1;
      const bool between = x == kWidth / 2 && (y < 12 || y >= 12 + door_cells);
      rows += wall || between ? '#' : '.';
    }
    rows += "\n";
  }
  return "scenario: 1\nsite:\n  site: 1\n  name: rooms\n  grid:\n    cell_m: 0.1\n    rows: |\n" +
         rows + "  start: {x_m: 1.0, y_m: 1.5, yaw_deg: 0}\n  hazards: [" + hazards +
         "]\nrobot: beluga\nplan: boustrophedon\n";
}

class UncoveredTest : public ScenarioTest {
 protected:
  static UncoveredFloor Find(const Scenario& s) {
    const PlanResult plan = MakePlan(s);
    EXPECT_EQ(plan.status, PlanStatus::kSuccess) << plan.message;
    return FindUncovered(s.world, plan,
                         ComputeSweepArea(KnownFloor(s.world), plan.clear, plan.tool,
                                          s.world.robot.spec.step_m, s.world.start.p()));
  }
};

TEST_F(UncoveredTest, WhatIsCoveredAndWhatIsNotMakeTheFloor) {
  const UncoveredFloor dut = Find(Read(TwoRooms(10)));
  EXPECT_NEAR(dut.floor_m2, 40 * 30 * 0.01 + 40 * 30 * 0.01 - 0.3 + 0.1, 0.3);
  double pockets_m2 = 0;
  for (const UncoveredPocket& pocket : dut.pockets) pockets_m2 += pocket.area_m2;
  EXPECT_NEAR(dut.covered_m2 + dut.edges_m2 + pockets_m2, dut.floor_m2, 1e-6);
  EXPECT_GT(dut.covered_m2, 0.95 * dut.floor_m2);
}

TEST_F(UncoveredTest, ARoomBehindANarrowDoorIsSaidWithTheDoor) {
  const UncoveredFloor dut = Find(Read(TwoRooms(3)));  // 0.3 m, the robot is 0.36 m wide
  ASSERT_THAT(dut.pockets, Not(IsEmpty()));
  const UncoveredPocket& room = dut.pockets.front();
  EXPECT_EQ(room.why, Why::kNarrow);
  EXPECT_NEAR(room.area_m2, 11.8, 0.5);
  EXPECT_GT(room.p_W.x(), 4.1);
  ASSERT_TRUE(room.gap_m);
  EXPECT_NEAR(*room.gap_m, 0.3, 0.1);
  EXPECT_NEAR((room.gap_W - Vec2(4.15, 3.2 - 1.35)).norm(), 0, 0.25);
}

TEST_F(UncoveredTest, ARoomWithoutADoorIsClosed) {
  const UncoveredFloor dut = Find(Read(TwoRooms(0)));
  ASSERT_THAT(dut.pockets, Not(IsEmpty()));
  EXPECT_EQ(dut.pockets.front().why, Why::kClosed);
}

TEST_F(UncoveredTest, ARoomBehindAHazardNamesIt) {
  const UncoveredFloor dut = Find(Read(TwoRooms(
      10,
      "{type: step, id: sill, polygon_m: [[4.0, 0.1], [4.3, 0.1], [4.3, 3.1], [4.0, 3.1]], "
      "height_m: 0.03}")));
  ASSERT_THAT(dut.pockets, SizeIs(::testing::Ge(2)));
  EXPECT_EQ(dut.pockets[0].why, Why::kBehind);
  EXPECT_EQ(dut.pockets[0].hazard, "sill");
  EXPECT_TRUE(std::ranges::any_of(dut.pockets, [](const UncoveredPocket& pocket) {
    return pocket.why == Why::kKeptOff && pocket.hazard == "sill";
  }));
}

// Not what lies next to the middle of the room: that it could drive around.
TEST_F(UncoveredTest, WhatClosesTheWayIsNamedAndNotWhatIsNearest) {
  for (const char* order : {"sill, post", "post, sill"}) {
    const std::string sill =
        "{type: step, id: sill, polygon_m: [[4.0, 0.1], [4.3, 0.1], [4.3, 3.1], [4.0, 3.1]], "
        "height_m: 0.03}";
    const std::string post =
        "{type: step, id: post, polygon_m: [[6.1, 1.5], [6.3, 1.5], [6.3, 1.7], [6.1, 1.7]], "
        "height_m: 0.05}";
    const bool first = order[0] == 's';
    const UncoveredFloor dut =
        Find(Read(TwoRooms(10, first ? sill + ", " + post : post + ", " + sill)));
    ASSERT_THAT(dut.pockets, Not(IsEmpty()));
    EXPECT_EQ(dut.pockets[0].why, Why::kBehind);
    EXPECT_EQ(dut.pockets[0].hazard, "sill") << order;
    EXPECT_LT((dut.pockets[0].p_W - Vec2(6.2, 1.6)).norm(),
              (dut.pockets[0].p_W - Vec2(4.3, 1.6)).norm())
        << "the post is nearer";
  }
}

// From a raised floor, or out of a pit, the base floor is another level, within the walls alone:
// part of the free floor that the robot cannot reach. The pockets add up to the total.
TEST_F(UncoveredTest, FloorsOfOtherLevelsAreUncovered) {
  Save("plan.csv", "x_m,y_m\n1.5,2.5\n5,2.5\n");
  for (const char* height_m : {"0.05", "-0.05"}) {
    const UncoveredFloor dut =
        Find(Read(RoomScenario(std::string("{type: step, height_m: ") + height_m +
                               ", polygon_m: [[0.75,0.75],[6,0.75],[6,4],[0.75,4]]}")));
    EXPECT_NEAR(dut.floor_m2, 8 * 4, 0.05);
    EXPECT_NEAR(dut.covered_m2, 3.5 * 0.3 + 0.07, 0.1);
    ASSERT_THAT(dut.pockets, SizeIs(2)) << height_m;
    EXPECT_EQ(dut.pockets[0].why, Why::kNotVisited);
    EXPECT_NEAR(dut.pockets[0].area_m2, 5.25 * 3.25 - dut.covered_m2 - dut.edges_m2, 0.05);
    EXPECT_NEAR(dut.pockets[0].area_m2 + dut.pockets[1].area_m2,
                dut.floor_m2 - dut.covered_m2 - dut.edges_m2, 1e-6);
    EXPECT_EQ(dut.pockets[1].why, Why::kKeptOff);
    EXPECT_EQ(dut.pockets[1].hazard, "base_floor");
    EXPECT_NEAR(dut.pockets[1].area_m2, 8 * 4 - 5.25 * 3.25, 0.5);
  }
}

// Up and down by turns, each turned by some degrees more; they lie across one another, and those at
// the rims reach into the walls and beyond the map.
std::string Shingle(int i) {
  const double x_m = 3.2 + 0.6 * (i % 10), y_m = 0.2 + 0.75 * (i / 10), turn = 0.13 * i;
  std::string corners;
  for (int k = 0; k < 4; ++k) {
    const double at = turn + k * kPi / 2;
    corners += (k > 0 ? ", [" : "[") + std::to_string(x_m + 0.5 * std::cos(at)) + ", " +
               std::to_string(y_m + 0.5 * std::sin(at)) + "]";
  }
  return "{type: step, id: shingle" + std::to_string(i) +
         ", height_m: " + (i % 2 ? "0.05" : "-0.05") + ", polygon_m: [" + corners + "]}";
}

std::vector<UncoveredPocket> LevelsOf(const UncoveredFloor& floor, const std::string& id) {
  std::vector<UncoveredPocket> levels;
  for (const UncoveredPocket& pocket : floor.pockets)
    if (pocket.why == Why::kKeptOff && pocket.hazard == id) levels.push_back(pocket);
  return levels;
}

TEST_F(UncoveredTest, EachOfManyLevelsThatOverlapIsThePocketThatItIsAlone) {
  constexpr int kShingles = 70;
  Save("plan.csv", "x_m,y_m\n1.5,2.5\n2.2,2.5\n");
  std::string all;
  for (int i = 0; i < kShingles; ++i) all += (i > 0 ? ", " : "") + Shingle(i);
  const Scenario scenario = Read(RoomScenario(all));
  const UncoveredFloor dut = Find(scenario);
  for (int i = 0; i < kShingles; ++i) {
    const std::string id = "shingle" + std::to_string(i);
    const std::vector<UncoveredPocket> level = LevelsOf(dut, id);
    ASSERT_THAT(level, SizeIs(1)) << id;
    const Polygon& polygon =
        scenario.world.site.map.hazards[static_cast<std::size_t>(i)].footprint[0];
    EXPECT_LT(SignedDistance(polygon, level[0].p_W), 0) << id;
    if (i % 8 != 0) continue;
    const std::vector<UncoveredPocket> alone = LevelsOf(Find(Read(RoomScenario(Shingle(i)))), id);
    ASSERT_THAT(alone, SizeIs(1)) << id;
    EXPECT_EQ(level[0].area_m2, alone[0].area_m2) << id;
    EXPECT_EQ(level[0].width_m, alone[0].width_m) << id;
    EXPECT_EQ(level[0].p_W, alone[0].p_W) << id;
  }
}

TEST_F(UncoveredTest, ALevelBesideTheMapIsNoPocket) {
  Save("plan.csv", "x_m,y_m\n1.5,2.5\n2.2,2.5\n");
  for (const Vec2& side : {Vec2(1, 0), Vec2(-1, 0), Vec2(0, 1), Vec2(0, -1)})
    for (const double away_m : {6.0, 9e5}) {
      const Vec2 at = Vec2(4.5, 2.5) + away_m * side;
      const std::string level = "{type: step, id: level, height_m: 0.05, polygon_m: [[" +
                                std::to_string(at.x()) + ", " + std::to_string(at.y()) + "], [" +
                                std::to_string(at.x() + 1) + ", " + std::to_string(at.y()) +
                                "], [" + std::to_string(at.x()) + ", " +
                                std::to_string(at.y() + 1) + "]]}";
      EXPECT_THAT(LevelsOf(Find(Read(RoomScenario(level))), "level"), IsEmpty()) << level;
    }
}

TEST_F(UncoveredTest, WhatAUsersPlanLeavesIsNotVisited) {
  Save("plan.csv", "x_m,y_m\n1.5,2.5\n6,2.5\n");
  const UncoveredFloor dut = Find(Read(RoomScenario("")));
  ASSERT_THAT(dut.pockets, SizeIs(1));
  EXPECT_EQ(dut.pockets[0].why, Why::kNotVisited);
  EXPECT_NEAR(dut.pockets[0].area_m2, 32 - 4.5 * 0.3 - 0.07, 0.5);
}

// On open floor, what a plan is expected to take is what its drive takes.
TEST_F(UncoveredTest, TimeAndEnergyAreThoseOfADrive) {
  for (const char* robot : {"beluga", "htetro"}) {
    Save("plan.csv", "x_m,y_m\n1.5,2.5\n6,2.5\n6,2.0\n2,2.0\n");
    Scenario scenario = Read(RoomScenario(""), {{"robot", robot}});
    const PlanBudget dut = EstimateBudget(scenario, MakePlan(scenario));
    EXPECT_FALSE(dut.battery_share);
    const EpisodeRecord record = Drive(std::move(scenario));
    EXPECT_EQ(record.outcome, Outcome::kSuccess);
    EXPECT_NEAR(dut.time_s, record.metrics.duration_s, 0.1 * record.metrics.duration_s) << robot;
    EXPECT_NEAR(dut.energy_j, record.metrics.energy_j, 0.1 * record.metrics.energy_j) << robot;
  }
}

// A step that the plan crosses slows nobody down, in a drive and in what is expected of one.
TEST_F(UncoveredTest, AStepOnTheWayIsNotExpectedToSlowTheDriveDown) {
  for (const char* robot : {"beluga", "htetro"})
    for (const char* height_m : {"0.0105", "-0.02"}) {
      const std::string step = std::string("{type: step, height_m: ") + height_m +
                               ", polygon_m: [[3, 0.5], [7, 0.5], [7, 4.5], [3, 4.5]]}";
      Save("plan.csv", "x_m,y_m\n1.5,2.5\n5.5,2.5\n");
      Scenario bare = Read(RoomScenario(""), {{"robot", robot}});
      Scenario scenario = Read(RoomScenario(step), {{"robot", robot}});
      ASSERT_TRUE(IsObstacle(scenario.world.site.map.hazards[0], scenario.world.robot.spec.step_m));
      const double time_s = EstimateBudget(scenario, MakePlan(scenario)).time_s;
      EXPECT_NEAR(time_s, EstimateBudget(bare, MakePlan(bare)).time_s, 1e-9) << robot << height_m;
    }
}

// Which pockets are gaps decides with --strict: a gap is named also where others are larger.
TEST_F(UncoveredTest, AGapAmongPocketsThatAreNotListedIsNamed) {
  Save("plan.csv", "x_m,y_m\n1.5,2.5\n6,2.5\n");
  Scenario scenario = Read(RoomScenario(""));
  const PlanResult plan = MakePlan(scenario);
  PlanCheck check = CheckPlan(scenario, plan);
  const auto text = [&](Why last) {
    check.uncovered.pockets.assign(7, {});
    for (int i = 0; i < 7; ++i) {
      UncoveredPocket& pocket = check.uncovered.pockets[static_cast<std::size_t>(i)];
      pocket.why = i < 6 ? Why::kClosed : last;
      pocket.area_m2 = 7 - i;
      pocket.p_W = {1.0 + i, 2};
    }
    std::string all;
    for (const std::string& line : PlanLines(scenario, plan, check)) all += line + "\n";
    return all;
  };
  EXPECT_THAT(text(Why::kClosed), HasSubstr("  and 2 more, 3 m2\n"));
  EXPECT_THAT(text(Why::kNotVisited),
              HasSubstr("  and 2 more, 3 m2, one of them within reach of the tool: 1 m2 around x "
                        "7.00, y 2.00 m\n"));
}

TEST_F(UncoveredTest, TheBatterysShareIsThatOfADrive) {
  Save("plan.csv", "x_m,y_m\n1.5,2.5\n6,2.5\n6,2.0\n2,2.0\n");
  const std::vector<Override> battery = {{"battery.capacity_wh", "2"},
                                         {"battery.resistance_ohm", "0.2"}};
  Scenario scenario = Read(RoomScenario(""), battery);
  const PlanBudget dut = EstimateBudget(scenario, MakePlan(scenario));
  const EpisodeRecord record = Drive(std::move(scenario));
  ASSERT_TRUE(dut.battery_share && record.metrics.battery_left);
  EXPECT_NEAR(*dut.battery_share, 1 - *record.metrics.battery_left, 0.1 * *dut.battery_share);
}

}  // namespace
}  // namespace floorproof
