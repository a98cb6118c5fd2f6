// SPDX-License-Identifier: Apache-2.0
#include "run/plan_check/expected_encounters.h"

#include <gmock/gmock.h>

#include "run/episode/encounter_table.h"
#include "run/scenario/override.h"
#include "run/scenario/scenario.h"
#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

class ExpectedEncountersTest : public ScenarioTest,
                               public ::testing::WithParamInterface<const char*> {};

// Covers low enough for all, one of them close to a wall, where robots slow down; a box beside the
// way; a turn on a mat; walls along the way.
constexpr const char* kHazards =
    "{type: cable_cover, id: cover, line_m: [[4, 0.5], [4, 4.5]], height_m: 0.003}, "
    "{type: cable_cover, id: askew, line_m: [[6, 0.5], [6.8, 3]], height_m: 0.003}, "
    "{type: carpet, id: mat, polygon_m: [[6.5, 3], [8, 3], [8, 4.3], [6.5, 4.3]], height_m: "
    "0.002}, "
    "{type: blind_object, id: box, polygon_m: [[2.4, 3], [3, 3], [3, 3.4], [2.4, 3.4]], "
    "height_m: 0.5}";
constexpr const char* kPlan = "x_m,y_m\n1.5,2.5\n3,2.5\n7.5,2.4\n7.5,3.6\n5,3.6\n5,1\n1.5,1\n";

// What is expected of a plan is what a drive of it meets in which nothing goes wrong.
TEST_P(ExpectedEncountersTest, AreThoseOfACleanDrive) {
  Save("plan.csv", kPlan);
  Scenario scenario = Read(RoomScenario(kHazards), {{"robot", GetParam()}});
  const Execution driven = Execute(scenario);
  ASSERT_THAT(driven.record.events, IsEmpty());
  const std::vector<Encounter>& want = driven.record.encounters;
  const std::vector<Encounter> dut = ExpectedEncounters(scenario, driven.plan);
  ASSERT_THAT(dut, SizeIs(want.size())) << EncountersCsv(dut) << EncountersCsv(want);
  for (std::size_t i = 0; i < dut.size(); ++i) {
    SCOPED_TRACE(want[i].hazard + want[i].type + " " + std::to_string(i));
    EXPECT_EQ(dut[i].hazard, want[i].hazard);
    EXPECT_EQ(dut[i].type, want[i].type);
    EXPECT_EQ(dut[i].passage, want[i].passage);
    EXPECT_EQ(dut[i].size, want[i].size);
    EXPECT_NEAR(dut[i].way_m, want[i].way_m, 0.05 + 0.05 * want[i].way_m);
    EXPECT_NEAR(dut[i].at.speed_mps, want[i].at.speed_mps, 0.03);
    if (want[i].hazard.empty()) continue;
    EXPECT_NEAR(WrapAngle(dut[i].at.heading_rad - want[i].at.heading_rad), 0, 0.06);
    EXPECT_NEAR(WrapAngle(dut[i].at.lead_rad - want[i].at.lead_rad), 0, 0.06);
    EXPECT_NEAR(dut[i].at.gap_m, want[i].at.gap_m, 1e-9) << "the plan's own";
    EXPECT_NEAR(dut[i].at.wall_m, want[i].at.wall_m, 0.03);
    EXPECT_NEAR(dut[i].at.turn_rad, want[i].at.turn_rad, 0.1);
    EXPECT_NEAR(dut[i].t_s, want[i].t_s, 1 + 0.02 * want[i].t_s);
  }
}

// What ends a drive before its plan does ends what is expected of it.
TEST_P(ExpectedEncountersTest, EndWhereTheDriveEnds) {
  Save("plan.csv", kPlan);
  const auto met = [&](const std::vector<Encounter>& encounters) {
    std::vector<std::string> hazards;
    for (const Encounter& e : encounters)
      if (!e.hazard.empty()) hazards.push_back(e.hazard);
    return hazards;
  };
  Scenario whole = Read(RoomScenario(kHazards), {{"robot", GetParam()}});
  for (const Override& end :
       {Override{"time_limit_s", "25"}, {"success.stop_at_coverage", "0.08"}}) {
    SCOPED_TRACE(end.key_path);
    Scenario scenario = Read(RoomScenario(kHazards), {{"robot", GetParam()}, end});
    const Execution driven = Execute(scenario);
    ASSERT_THAT(driven.record.events, IsEmpty());
    const std::vector<std::string> want = met(driven.record.encounters);
    EXPECT_EQ(met(ExpectedEncounters(scenario, driven.plan)), want);
    EXPECT_LT(want.size(), met(ExpectedEncounters(whole, driven.plan)).size());
  }
}

INSTANTIATE_TEST_SUITE_P(Robots, ExpectedEncountersTest,
                         ::testing::Values("beluga", "htetro", "rover"),
                         [](const auto& of) { return std::string(of.param); });

}  // namespace
}  // namespace floorproof
