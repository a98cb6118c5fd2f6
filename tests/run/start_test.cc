// SPDX-License-Identifier: Apache-2.0
// A start is where a robot can stand: on its floor, whatever the floor's level, and in nothing.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "run/episode/intervention.h"
#include "run/episode/make_plan.h"
#include "run/episode/records.h"
#include "run/scenario/override.h"
#include "run/scenario/scenario.h"
#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class StartTest : public ScenarioTest {
 protected:
  StartTest() { Save("plan.csv", "x_m,y_m,yaw_rad\n1.5,2.5,0\n3.5,2.5,0\n"); }
  // The floor from 0.75 m to 6 m lies so high.
  static std::string Level(double height_m, bool known = true) {
    return fmt::format(
        "{{type: step, id: level, height_m: {}, known: {}, "
        "polygon_m: [[0.75,0.75],[6,0.75],[6,4],[0.75,4]]}}",
        height_m, known);
  }
  std::string WhyRefused(const std::string& hazards, const std::string& robot,
                         const std::string& more = "") const {
    try {
      Read(RoomScenario(hazards, more), {{"robot", robot}});
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }
};

// As on the base floor, whatever the level: the same drive, where the tracker knows of no edge that
// it should slow down beside.
TEST_F(StartTest, OnARaisedFloorAndInAPitItDrivesAsOnTheBaseFloor) {
  for (const char* robot : {"beluga", "htetro"}) {
    const EpisodeRecord flat = Drive(Read(RoomScenario(""), {{"robot", robot}}));
    ASSERT_EQ(flat.outcome, Outcome::kSuccess) << robot;
    for (const double height_m : {0.004, 0.15, -0.05, -0.5}) {
      const EpisodeRecord told = Drive(Read(RoomScenario(Level(height_m)), {{"robot", robot}}));
      EXPECT_EQ(told.outcome, Outcome::kSuccess) << robot << " " << height_m;
      EXPECT_NEAR(told.metrics.duration_s, flat.metrics.duration_s, 0.1) << robot << height_m;
      EXPECT_GT(told.metrics.coverage, 0.02) << robot << " " << height_m;
      const EpisodeRecord dut =
          Drive(Read(RoomScenario(Level(height_m, false)), {{"robot", robot}}));
      EXPECT_EQ(dut.outcome, Outcome::kSuccess) << robot << " " << height_m;
      EXPECT_THAT(dut.events, IsEmpty()) << robot << " " << height_m;
      EXPECT_NEAR(dut.trace.front().z_m, height_m, 2e-3) << robot;
      EXPECT_NEAR(dut.trace.back().z_m, height_m, 2e-3) << robot;
      EXPECT_NEAR(dut.metrics.duration_s, flat.metrics.duration_s, 0.1) << robot << " " << height_m;
      EXPECT_NEAR(dut.metrics.energy_j, flat.metrics.energy_j, 0.02 * flat.metrics.energy_j)
          << robot << " " << height_m;
    }
  }
}

// A room whose whole floor lies so high has the plans, and the drives, of a room.
TEST_F(StartTest, ARaisedRoomIsPlannedAndDrivenAsARoom) {
  const std::string all =
      "{{type: step, height_m: {}, polygon_m: [[0.5,0.5],[8.5,0.5],[8.5,4.5],[0.5,4.5]]}}";
  for (const char* planner : {"boustrophedon", "spiral", "path_transform"}) {
    const std::vector<Override> drawn = {{"plan", planner}, {"risk", "{}"}};
    const PlanResult flat = MakePlan(Read(RoomScenario(""), drawn));
    ASSERT_EQ(flat.status, PlanStatus::kSuccess) << planner << ": " << flat.message;
    for (const double height_m : {0.15, -0.05}) {
      const PlanResult dut =
          MakePlan(Read(RoomScenario(fmt::format(fmt::runtime(all), height_m)), drawn));
      ASSERT_EQ(dut.status, PlanStatus::kSuccess) << planner << ": " << dut.message;
      ASSERT_EQ(dut.path.size(), flat.path.size()) << planner << " " << height_m;
      for (std::size_t i = 0; i < dut.path.size(); ++i)
        EXPECT_EQ(dut.path[i].p_W, flat.path[i].p_W) << planner << " " << height_m;
    }
  }
  const EpisodeRecord flat = Drive(Read(RoomScenario("")));
  const EpisodeRecord dut = Drive(Read(RoomScenario(fmt::format(fmt::runtime(all), 0.15))));
  EXPECT_NEAR(dut.metrics.coverage, flat.metrics.coverage, 0.002);
  EXPECT_GT(dut.metrics.coverage, 0.01);
}

// Its lidar looks over the robot's own floor: from a pit it meets the base floor's side.
TEST_F(StartTest, InAPitItIsLocalisedByThePitsWalls) {
  const EpisodeRecord dut =
      Drive(Read(RoomScenario(Level(-0.5), "sensors: {lidar: {}}\n"), {{"estimator", "mcl"}}));
  EXPECT_EQ(dut.outcome, Outcome::kSuccess);
  EXPECT_LT(dut.metrics.max_estimate_error_m, 0.1);
}

// Planners keep to the floor on which the robot starts, and off its edge.
TEST_F(StartTest, PlansStayOnTheFloorOfTheStart) {
  for (const double height_m : {0.15, -0.05}) {
    const Scenario s = Read(RoomScenario(Level(height_m)), {{"plan", "boustrophedon"}});
    const PlanResult dut = MakePlan(s);
    ASSERT_EQ(dut.status, PlanStatus::kSuccess) << dut.message;
    for (const Waypoint& w : dut.path)
      EXPECT_LT(SignedDistance(s.world.site.map.hazards[0].footprint[0], w.p_W),
                -s.world.robot.spec.inscribed_radius_m);
    EXPECT_GT(Length(dut.path) * s.world.robot.spec.tool_width_m, 0.8 * 5.25 * 3.25) << height_m;
  }
}

// The edge of the level that it was set down on is a hazard still: its front wheels fall, and its
// belly hangs there, as at the edge of a pit.
TEST_F(StartTest, TheEdgeOfARaisedFloorIsThatOfAPit) {
  Save("plan.csv", "x_m,y_m\n1.5,2.5\n7.5,2.5\n");
  const std::string pit =
      "{type: step, id: pit, height_m: -0.15, polygon_m: [[6,0.75],[8.5,0.75],[8.5,4],[6,4]]}";
  for (const char* robot : {"beluga", "htetro"}) {
    const auto drive = [&](const std::string& hazards) {
      return Drive(Read(RoomScenario(hazards, "on_failure: ignore\n"), {{"robot", robot}}));
    };
    const EpisodeRecord raised = drive(Level(0.15)), dut = drive(pit);
    ASSERT_GE(raised.events.size(), 2u) << robot;
    ASSERT_GE(dut.events.size(), 2u) << robot;
    for (const bool is_pit : {false, true}) {
      const std::vector<Event>& events = is_pit ? dut.events : raised.events;
      EXPECT_EQ(events[0].kind, "fell") << robot;
      EXPECT_EQ(events[0].hazard, is_pit ? "pit" : "level") << robot;
      EXPECT_NEAR(events[0].x_m, 6.0, 0.2) << robot;
      EXPECT_EQ(events[1].kind, "high_centred") << robot;
      EXPECT_EQ(events[1].hazard, is_pit ? "pit" : "level") << robot;
    }
    EXPECT_NEAR(raised.events[0].t_s, dut.events[0].t_s, 0.1) << robot;
  }
}

TEST_F(StartTest, WhatItOverlapsIsNamed) {
  for (const char* robot : {"beluga", "htetro"}) {
    for (const auto& [id, hazard] :
         {std::pair("pillar",
                    "{type: blind_object, id: pillar, "
                    "polygon_m: [[1.6,2.4],[1.8,2.4],[1.8,2.6],[1.6,2.6]]}"),
          {"pane", "{type: glass, id: pane, line_m: [[1.6,2],[1.6,3]]}"},
          {"kerb",
           "{type: step, id: kerb, height_m: 0.1, "
           "polygon_m: [[1.6,2],[2.4,2],[2.4,3],[1.6,3]]}"}})
      EXPECT_THAT(WhyRefused(hazard, robot),
                  AllOf(HasSubstr("scenario.yaml:"), HasSubstr("start"), HasSubstr("1.5, 2.5"),
                        HasSubstr(id), HasSubstr("must stand on one floor")))
          << robot;
    EXPECT_THAT(WhyRefused("", robot, "start: {x_m: 0.6, y_m: 2.5}\n"),
                HasSubstr("overlaps a wall"))
        << robot;
    EXPECT_EQ(WhyRefused("{type: blind_object, polygon_m: [[2.5,2.4],[2.8,2.4],[2.8,2.6]]}", robot),
              "");
  }
}

TEST_F(StartTest, AcrossAnEdgeIsRefused) {
  for (const double height_m : {0.004, 0.05, -0.05})
    EXPECT_THAT(WhyRefused(fmt::format("{{type: step, id: level, height_m: {}, "
                                       "polygon_m: [[1.5,1],[4,1],[4,4],[1.5,4]]}}",
                                       height_m),
                           "htetro"),
                HasSubstr("across the edge of level"));
}

// Rover, 0.624 m x 0.58 m, starts in an aisle in which it cannot turn. It is led straight ahead,
// out of the aisle, and then plans as from there.
TEST_F(StartTest, FromAnAisleTooNarrowToTurnThePlanLeadsStraightAhead) {
  std::string rows;
  for (int row = 0; row < 32; ++row)
    rows += "      " + std::string(25, row < 12 || row >= 19 ? '#' : '.') +
            std::string(35, row == 0 || row == 31 ? '#' : '.') + "#\n";
  const auto aisle = [&](double yaw_deg) {
    return "scenario: 1\nsite:\n  site: 1\n  name: aisle\n  grid:\n    cell_m: 0.1\n"
           "    rows: |\n" +
           rows + fmt::format("  start: {{x_m: 1.5, y_m: 1.65, yaw_deg: {}}}\n", yaw_deg) +
           "robot: rover\nplan: boustrophedon\n";
  };
  const Scenario s = Read(aisle(0));
  const PlanResult dut = MakePlan(s);
  ASSERT_EQ(dut.status, PlanStatus::kSuccess) << dut.message;
  EXPECT_THAT(dut.message, HasSubstr("straight ahead"));
  EXPECT_EQ(dut.path.front().p_W, s.world.start.p());
  EXPECT_NEAR(dut.path[1].p_W.y(), s.world.start.y_m, 1e-6);
  EXPECT_GT(dut.path[1].p_W.x(), 2.5);
  EXPECT_GT(PlanJson(s, dut, nullptr)["coverage"].get<double>(), 0.9);
  const PlanResult back = MakePlan(Read(aisle(180)));
  EXPECT_EQ(back.status, PlanStatus::kStartBlocked);
  EXPECT_THROW(Read(aisle(45)), InputError);
}

// Help sets a robot down on the floor at its waypoint, whatever its level.
TEST_F(StartTest, HelpSetsItDownOnTheFloorThatIsThere) {
  Path path(3);
  path[0].p_W = {1.5, 2.5};
  path[1].p_W = {6, 2.5};  // across the edge
  path[2].p_W = {4, 2.5};
  for (const char* robot : {"beluga", "htetro"})
    for (const double height_m : {0.15, -0.15}) {
      const auto dut =
          PlaceAhead(Read(RoomScenario(Level(height_m)), {{"robot", robot}}).world, path, 1);
      ASSERT_TRUE(dut) << robot << " " << height_m;
      EXPECT_EQ(dut->waypoint, 2u) << robot << " " << height_m;
    }
}

// Rough ground below its belly: it stands on the bumps, and stays where it is.
TEST_F(StartTest, OnRoughGroundItStandsStill) {
  for (const char* robot : {"beluga", "htetro"}) {
    Scenario s = Read(RoomScenario("{type: rough, amplitude_m: 0.003, wavelength_m: 0.07, "
                                   "polygon_m: [[0.75,1.5],[3,1.5],[3,3.5],[0.75,3.5]]}"),
                      {{"robot", robot}});
    const Scene scene = BuildScene(s.world.site.map, s.world.robot, s.world.physics, s.world.start);
    Simulation dut(scene, s.world.site.map, s.world.robot.spec);
    dut.Reset(s.world.start);
    const Vec3 stood_W = dut.truth().p_WB;
    for (int i = 0; i < 250; ++i) ASSERT_TRUE(dut.Step());
    EXPECT_LT((dut.truth().p_WB - stood_W).norm(), 0.003) << robot;
    EXPECT_LT(dut.truth().tilt_rad, 0.05) << robot;
    EXPECT_GE(stood_W.z(), -1e-3) << robot;
  }
}

}  // namespace
}  // namespace floorproof
