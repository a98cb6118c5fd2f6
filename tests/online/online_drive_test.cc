// SPDX-License-Identifier: Apache-2.0
// Planners of unknown floors, driven through physics.
#include <gmock/gmock.h>

#include "run/episode/records.h"
#include "run/scenario/scenario.h"
#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

using ::testing::HasSubstr;

struct OnlineDrive {
  std::string planner, robot;
};
void PrintTo(const OnlineDrive& drive, std::ostream* out) {
  *out << drive.planner << " on " << drive.robot;
}

class OnlineDriveTest : public ScenarioTest {
 protected:
  OnlineDriveTest() { Save("plan.csv", "x_m,y_m\n1.5,2.5\n"); }
  // A room of 4 m x 3 m, a cupboard in it.
  Scenario Room(const std::string& planner, const std::string& hazards = "",
                const std::string& more = "") const {
    return Read(
        "scenario: 1\nsite:\n  site: 1\n  grid:\n    cell_m: 0.5\n    rows: |\n"
        "      ##########\n      #........#\n      #........#\n      #.....##.#\n"
        "      #........#\n      #........#\n      #........#\n      ##########\n"
        "  start: {x_m: 1.5, y_m: 2.0, yaw_deg: 0}\n  hazards: [" +
        hazards + "]\nplan: " + planner + "\n" +
        (more.find("robot:") == std::string::npos ? "robot: beluga\n" : "") + more);
  }
  static EpisodeRecord Record(Scenario scenario) { return Execute(scenario).record; }
};

class OnlineDriveOf : public OnlineDriveTest, public ::testing::WithParamInterface<OnlineDrive> {};

TEST_P(OnlineDriveOf, CoversARoomThatItDoesNotKnow) {
  const auto& [planner, robot] = GetParam();
  // The random walk ends at no time of its own.
  const std::string limit = planner == "random_walk" ? "300" : "900";
  const EpisodeRecord dut =
      Record(Room(planner, "", "time_limit_s: " + limit + "\nrobot: " + robot + "\n"));
  EXPECT_TRUE(dut.events.empty());
  EXPECT_EQ(dut.metrics.reactions, 0) << "a lidar sees all that is there";
  EXPECT_GT(dut.metrics.coverage, planner == "frontier_coverage" ? 0.9 : 0.5);
  ASSERT_TRUE(dut.known);
  if (planner == "random_walk") return;
  EXPECT_EQ(dut.outcome, Outcome::kSuccess) << dut.message;
  EXPECT_THAT(dut.message, HasSubstr("all known floor"));
  EXPECT_FALSE(dut.figures.empty());
  EXPECT_GT(dut.metrics.turns, 5);
}

INSTANTIATE_TEST_SUITE_P(Planners, OnlineDriveOf,
                         ::testing::Values(OnlineDrive{"rolling_window", "beluga"},
                                           OnlineDrive{"random_walk", "beluga"},
                                           OnlineDrive{"frontier_coverage", "beluga"},
                                           OnlineDrive{"frontier_coverage", "htetro"}));

TEST_F(OnlineDriveTest, ASeenObjectIsGoneAroundAnUnseenEdgeIsMetAndMarked) {
  const EpisodeRecord dut = Record(
      Room("{planner: frontier_coverage, speed_mps: 0.1}",
           "{type: step, id: pit, polygon_m: [[3.2, 3.0], [3.7, 3.0], [3.7, 3.4], [3.2, 3.4]], "
           "height_m: -0.1}, {type: blind_object, id: crate, polygon_m: [[2.2, 0.9], [2.6, 0.9], "
           "[2.6, 1.3], [2.2, 1.3]], height_m: 0.5}",
           "on_failure: ignore\ntime_limit_s: 1500\n"));
  EXPECT_EQ(std::ranges::count(dut.events, FailureMode::kRollOver, &Event::mode), 0);
  EXPECT_EQ(std::ranges::count(dut.events, FailureMode::kBounceBack, &Event::mode), 0);
  EXPECT_GE(dut.metrics.reactions, 1) << "no lidar sees the pit";
  EXPECT_GT(dut.metrics.coverage, 0.85);
  EXPECT_GT(std::ranges::count(dut.known->marks, FloorMark::Kind::kDrop, &FloorMark::kind), 0);
}

TEST_F(OnlineDriveTest, TheSpeedIsThePlannersOwn) {
  const auto fastest = [&](const std::string& plan) {
    float most = 0;
    for (const TraceRow& row : Record(Room(plan, "", "time_limit_s: 20\n")).trace)
      most = std::max(most, row.cmd_vx_mps);
    return most;
  };
  EXPECT_NEAR(fastest("{planner: rolling_window, speed_mps: 0.1}"), 0.1f, 1e-4f);
  EXPECT_NEAR(fastest("rolling_window"), 0.25f, 1e-4f);
}

TEST_F(OnlineDriveTest, TheSameSeedDrivesTheSameWay) {
  const auto trace = [&](int seed) {
    return TraceCsv(
        Record(Room("random_walk", "", "time_limit_s: 40\nseed: " + std::to_string(seed) + "\n")),
        {});
  };
  const std::string once = trace(3);
  EXPECT_EQ(once, trace(3));
  EXPECT_NE(once, trace(4));
}

// The estimator may read the site's map; the planner goes by what was seen.
TEST_F(OnlineDriveTest, DrivesByItsOwnEstimate) {
  const EpisodeRecord dut = Record(Room("frontier_coverage", "", "estimator: mcl\n"));
  EXPECT_TRUE(dut.events.empty());
  EXPECT_GT(dut.metrics.coverage, 0.85);
}

TEST_F(OnlineDriveTest, ADriveThatEndsBeforeItsPlannerWasAskedHasNoFigures) {
  const EpisodeRecord dut = Record(Room("frontier_coverage", "", "time_limit_s: 0.5\n"));
  EXPECT_EQ(dut.outcome, Outcome::kTimeout);
  EXPECT_TRUE(dut.figures.empty());
  EXPECT_EQ(dut.metrics.turns, 0);
}

TEST_F(OnlineDriveTest, ARobotWalledInIsNotPlanned) {
  const EpisodeRecord dut =
      Record(Read("scenario: 1\nsite: {site: 1, grid: {cell_m: 0.5, rows: \"###\\n#.#\\n###\\n\"}, "
                  "start: {x_m: 0.75, y_m: 0.75, yaw_deg: 0}}\nrobot: beluga\n"
                  "plan: rolling_window\n"));
  EXPECT_EQ(dut.outcome, Outcome::kNotPlanned);
  EXPECT_THAT(dut.message, HasSubstr("no free floor"));
}

}  // namespace
}  // namespace floorproof
