// SPDX-License-Identifier: Apache-2.0
// `drive: cells`: from the scenario to its record, and what is refused.
#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "run/episode/records.h"
#include "run/scenario/chance.h"
#include "run/scenario/resolved_scenario.h"
#include "run/scenario/scenario_file.h"
#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class CellDriveTest : public ScenarioTest {
 protected:
  static std::string Text(const std::string& more, const std::string& rows = kRows) {
    return "scenario: 1\nsite: {site: 1, grid: {cell_m: 0.5, rows: \"" + rows +
           "\"}, start: {x_m: 0.75, y_m: 0.75, yaw_deg: 0}}\nrobot: beluga\n" + more;
  }
  static EpisodeRecord Record(Scenario scenario) { return Execute(scenario).record; }
  std::string WhyRefused(const std::string& more) const {
    try {
      Read(Text(more));
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }

  static constexpr const char* kRows =
      "########\\n#......#\\n#..##..#\\n#..##..#\\n#......#\\n########\\n";
};

TEST_F(CellDriveTest, CoversTheFloorAndSaysWhatItDrove) {
  Scenario s = Read(Text("plan: rolling_window\ndrive: cells\n"));
  const Execution dut = Execute(s);
  EXPECT_EQ(dut.plan.status, PlanStatus::kOnline);
  const EpisodeRecord& record = dut.record;
  EXPECT_EQ(record.outcome, Outcome::kSuccess) << record.message;
  const Metrics& m = record.metrics;
  EXPECT_EQ(m.coverage, 1);
  EXPECT_EQ(m.revisited, m.overlap) << "all is covered";
  EXPECT_EQ(record.steps, static_cast<std::int64_t>(record.trace.size()));
  // 20 cells; a step is 0.5 m or its diagonal.
  EXPECT_NEAR(m.extra_visits, (static_cast<double>(record.steps) - 20) / 20, 1e-12);
  EXPECT_GE(m.path_length_m, 0.5 * static_cast<double>(record.steps - 1));
  EXPECT_LE(m.path_length_m, 0.71 * static_cast<double>(record.steps - 1));
  EXPECT_NEAR(m.duration_s, m.path_length_m / s.world.robot.spec.cruise_mps, 1e-9);
  EXPECT_EQ(record.trace.back().coverage, 1);
  for (std::size_t i = 1; i < record.trace.size(); ++i)
    EXPECT_GE(record.trace[i].revisited, record.trace[i - 1].revisited);
}

TEST_F(CellDriveTest, StopsWhereItIsToldOrWhereTimeRunsOut) {
  const EpisodeRecord half =
      Record(Read(Text("plan: random_walk\ndrive: cells\nsuccess: {stop_at_coverage: 0.5}\n")));
  EXPECT_EQ(half.outcome, Outcome::kSuccess);
  EXPECT_EQ(half.metrics.coverage, 0.5);
  const EpisodeRecord late =
      Record(Read(Text("plan: random_walk\ndrive: cells\ntime_limit_s: 60\n")));
  EXPECT_EQ(late.outcome, Outcome::kTimeout);
  EXPECT_NEAR(late.metrics.duration_s, 60, 3);
  const EpisodeRecord little =
      Record(Read(Text("plan: rolling_window\ndrive: cells\n"
                       "success: {min_coverage: 0.9, stop_at_coverage: 0.5}\n")));
  EXPECT_EQ(little.outcome, Outcome::kFailure) << "stopped before it had covered enough";
}

TEST_F(CellDriveTest, WhatARobotMustKeepOffIsBlocked) {
  Scenario s = Read(Text("plan: frontier_coverage\ndrive: cells\n",
                         "########\\n#..G...#\\n#..G...#\\n#..v...#\\n#..=...#\\n########\\n"));
  const EpisodeRecord dut = Record(std::move(s));
  EXPECT_EQ(dut.outcome, Outcome::kSuccess);
  EXPECT_EQ(dut.passes(3, 4), 0) << "glass";
  EXPECT_EQ(dut.passes(3, 2), 0) << "a drop";
  EXPECT_EQ(dut.passes(3, 1), 1) << "a cable cover is driven over";
  EXPECT_EQ(dut.metrics.coverage, 1);
}

TEST_F(CellDriveTest, ARobotWalledInIsNotPlanned) {
  const EpisodeRecord dut = Record(Read(
      Text("plan: rolling_window\ndrive: cells\n", "#####\\n#####\\n##..#\\n#.###\\n#####\\n")));
  EXPECT_EQ(dut.outcome, Outcome::kNotPlanned);
  EXPECT_THAT(dut.message, HasSubstr("no free floor"));
}

TEST_F(CellDriveTest, WhatDoesNotGoTogetherIsRefusedAtItsKey) {
  EXPECT_THAT(WhyRefused("drive: cells\nplan: {planner: rolling_window, radius_m: 0.3}\n"),
              AllOf(HasSubstr("scenario.yaml:5"), HasSubstr("plan.radius_m = 0.3"),
                    HasSubstr("at least the step, 0.5 m")));
  EXPECT_THAT(WhyRefused("drive: cells\nplan: {planner: rolling_window, step_m: 0.25}\n"),
              AllOf(HasSubstr("plan.step_m"), HasSubstr("the site's cell, 0.5 m")));
  EXPECT_THAT(WhyRefused("drive: cells\nplan: {planner: random_walk, radius_m: 1e9}\n"),
              AllOf(HasSubstr("plan.radius_m"), HasSubstr("at most 200 steps, 100 m")));
  EXPECT_THAT(WhyRefused("drive: cells\nplan: spiral\n"),
              AllOf(HasSubstr("scenario.yaml:4"), HasSubstr("planners of unknown floors")));
  EXPECT_THAT(WhyRefused("drive: cells\nplan: rolling_windows\n"),
              AllOf(HasSubstr("did you mean rolling_window?"), HasSubstr("boustrophedon")));
}

// However long it takes, with one row for every so many moves.
TEST_F(CellDriveTest, AVeryLongDriveKeepsItsTraceInBounds) {
  const EpisodeRecord dut =
      Record(Read(Text("plan: random_walk\ndrive: cells\ntime_limit_s: 7e6\n")));
  EXPECT_EQ(dut.outcome, Outcome::kTimeout);
  EXPECT_GT(dut.steps, 2'000'000);
  EXPECT_LE(dut.trace.size(), 1'000'000u);
  EXPECT_GT(dut.trace.size(), 400'000u);
  EXPECT_EQ(dut.trace.front().t_s, 0);
  EXPECT_GT(dut.trace.back().t_s, 6.9e6);
  EXPECT_TRUE(std::ranges::is_sorted(dut.trace, {}, &TraceRow::t_s));
}

// Nothing of it is measured beforehand.
TEST_F(CellDriveTest, ItsPlanSaysThatItIsMadeOnTheWay) {
  const Scenario s = Read(Text("plan: rolling_window\ndrive: cells\n"));
  const auto json = PlanJson(s, MakePlan(s));
  EXPECT_EQ(json["status"], "online");
  EXPECT_EQ(json["planner"], "rolling_window");
  EXPECT_FALSE(json.contains("length_m"));
}

TEST_F(CellDriveTest, WithoutADriveThereIsNoPlan) {
  const EpisodeRecord dut = Record(Read(Text("plan: rolling_window\ndrive: none\n")));
  EXPECT_EQ(dut.outcome, Outcome::kNotPlanned);
  EXPECT_THAT(dut.message, HasSubstr("plans while it drives"));
}

TEST_F(CellDriveTest, ChanceIsWhereItsPlannerDraws) {
  const auto differ = [&](const std::string& more) {
    const ScenarioFile file(Save("s.yaml", Text(more)));
    return EpisodesCanDiffer(file, file.Read(std::nullopt));
  };
  EXPECT_TRUE(differ("plan: random_walk\ndrive: cells\n"));
  EXPECT_FALSE(differ("plan: random_walk\ndrive: none\n"));
  EXPECT_FALSE(differ("plan: rolling_window\ndrive: cells\nsensors: {lidar: {}}\n"));
}

TEST_F(CellDriveTest, AResolvedScenarioDrivesTheSame) {
  Scenario s =
      Read(Text("plan: {planner: random_walk, radius_m: 1}\ndrive: cells\nseed: 5\n"
                "success: {stop_at_coverage: 0.9}\n"));
  const std::string resolved = ResolvedScenario(s, folder_);
  const EpisodeRecord first = Record(std::move(s));
  const EpisodeRecord again = Record(ReadScenario(Save("r.yaml", resolved)));
  EXPECT_EQ(TraceCsv(first, {}), TraceCsv(again, {}));
}

}  // namespace
}  // namespace floorproof
