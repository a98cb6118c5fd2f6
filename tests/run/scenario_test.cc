// SPDX-License-Identifier: Apache-2.0

#include <gmock/gmock.h>

#include "base/file_output.h"
#include "run/scenario/resolved_scenario.h"
#include "run/scenario/scenario_file.h"
#include "run/scenario/warnings.h"
#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

using ::testing::HasSubstr;

class ScenarioFile : public ScenarioTest {
 protected:
  ScenarioFile() { Save("plan.csv", "x_m,y_m\n1.5,2.5\n3,2.5\n"); }
  std::string Refusal(const std::string& text, const std::vector<Override>& overrides = {}) const {
    try {
      Read(text, overrides);
    } catch (const InputError& e) {
      return e.what();
    }
    return "accepted";
  }
};

TEST_F(ScenarioFile, OverridesReachIntoScenarioAndSite) {
  const Scenario dut = Read(RoomScenario(""), {{"control_hz", "25"},
                                               {"trace_hz", "25"},
                                               {"site.floor.friction", "0.5"},
                                               {"failures.stuck.turn_rad", "0.7"}});
  EXPECT_EQ(dut.spec.episode.control_hz, 25);
  EXPECT_EQ(dut.world.site.map.floor_friction, 0.5);
}

// Trackers cap what is asked for: that it is not driven so fast is said.
TEST_F(ScenarioFile, ASpeedThatTheRobotDoesNotHaveIsSaid) {
  const auto warnings = [&](double mps, const std::string& more = "") {
    Save("plan.csv",
         "x_m,y_m,speed_mps\n1.5,2.5,\n2,2.5,0.1\n3,2.5," + std::to_string(mps) + "\n4,2.5,0.1\n");
    std::string said;
    for (const std::string& line : Warnings(Read(RoomScenario("", more)))) said += line + "\n";
    return said;
  };
  const double most_mps = Read(RoomScenario("")).world.robot.spec.max_speed_mps;
  EXPECT_EQ(warnings(most_mps), "");
  EXPECT_THAT(warnings(2), HasSubstr("plan.csv, 1 of 4 waypoints from number 3 on: speed_mps of up "
                                     "to 2 m/s is more than beluga drives: "));
  EXPECT_EQ(warnings(0.1, "react: {back_off_mps: 0.1}\n"), "");
  EXPECT_THAT(warnings(0.1, "react: {back_off_mps: 7}\n"),
              HasSubstr("react.back_off_mps 7 m/s is more than beluga drives: "));
}

// `init` writes one, for coverage; an audit judged by it fails each time.
TEST_F(ScenarioFile, ACoverageThatIsAskedOfAnAuditIsSaidToBeInTheWay) {
  const auto warnings = [&](const std::string& planner) {
    std::string said;
    for (const std::string& line :
         Warnings(Read(RoomScenario("", "success: {min_coverage: 0.95}\n"),
                       {{"plan", "{planner: " + planner + "}"}})))
      said += line + "\n";
    return said;
  };
  EXPECT_EQ(warnings("boustrophedon"), "");
  EXPECT_THAT(warnings("audit"), HasSubstr("success.min_coverage is 0.95, and the planner audit"));
}

TEST_F(ScenarioFile, ResolvedTwiceIsItself) {
  const Scenario first =
      Read(RoomScenario("{type: step, polygon_m: [[3, 1], [4, 1], [4, 2]], height_m: 0.002}",
                        "start: {yaw_deg: 213.7}\n"));
  const std::string once = ResolvedScenario(first, folder_ / "out");
  std::filesystem::create_directories(folder_ / "out");
  WriteFileWhole(folder_ / "out" / "scenario.resolved.yaml", once);
  const Scenario second =
      ReadScenario(folder_ / "out" / "scenario.resolved.yaml", {}, Trust::kFull);
  EXPECT_EQ(ResolvedScenario(second, folder_ / "out"), once);
  EXPECT_EQ(second.world.start.yaw_rad, first.world.start.yaw_rad) << "to the bit";
}

TEST_F(ScenarioFile, AGeneratedSiteIsResolvedAsDrawn) {
  const std::string text =
      "scenario: 1\nrobot: beluga\ndrive: none\nsite: {site: 1, generate: {kind: room}}\n";
  const Scenario first = Read(text, {{"seed", "3"}, {"site.generate.cells", "[12, 9]"}});
  EXPECT_EQ(first.world.site.map.frame.width, 12);
  const std::string once = ResolvedScenario(first, folder_);
  const Scenario second = Read(once);
  EXPECT_EQ(second.world.site.map.occupancy.cells, first.world.site.map.occupancy.cells);
  EXPECT_EQ(second.world.start.x_m, first.world.start.x_m);
  EXPECT_EQ(second.world.goal, first.world.goal);
  EXPECT_EQ(ResolvedScenario(second, folder_), once);
  EXPECT_NE(Read(text, {{"seed", "4"}}).world.site.map.occupancy.cells,
            Read(text, {{"seed", "3"}}).world.site.map.occupancy.cells);
}

// Its keys may be drawn; the site stands drawn in the resolved file, and takes none.
TEST_F(ScenarioFile, AGeneratedSiteOfDrawnKeysIsReadAgainAsItWas) {
  const Scenario first = Read(
      "scenario: 1\nrobot: beluga\ndrive: none\nsite: {site: 1, generate: {kind: room}}\n"
      "randomise: {site.generate.cells: {choice: [[12, 9], [9, 12]]}, "
      "start.yaw_deg: {uniform: [0, 90]}}\n");
  const std::string once = ResolvedScenario(first, folder_);
  const Scenario second = Read(once);
  EXPECT_EQ(second.world.site.map.occupancy.cells, first.world.site.map.occupancy.cells);
  EXPECT_EQ(second.world.start.yaw_rad, first.world.start.yaw_rad) << "drawn again as before";
  EXPECT_EQ(ResolvedScenario(second, folder_), once);
  EXPECT_THAT(once, ::testing::Not(HasSubstr("site.generate")));
}

// Each variant's planner has its own keys; what is written of them is not lost.
TEST_F(ScenarioFile, ItsVariantsMayHaveOtherPlannersOnceItIsResolved) {
  const std::string text = RoomScenario("");
  const floorproof::ScenarioFile file(
      Save("v.yaml", text.substr(0, text.find("plan:")) +
                         "plan: {planner: rolling_window, radius_m: 2.5}\ndrive: cells\n"
                         "matrix: {plan.planner: [rolling_window, random_walk]}\n"));
  const std::string once = ResolvedScenario(file.Read(std::nullopt), folder_);
  const floorproof::ScenarioFile again(Save("r.yaml", once));
  ASSERT_EQ(again.variants().size(), 2u);
  for (const Variant& variant : again.variants()) {
    const Scenario dut = again.Read(0, variant);
    EXPECT_EQ(dut.spec.online.radius_m, 2.5) << dut.spec.planner_name;
  }
  EXPECT_EQ(ResolvedScenario(again.Read(std::nullopt), folder_), once);
}

TEST_F(ScenarioFile, WheelsAreIdealOrHaveRollersThatAreBodies) {
  const std::vector<Override> htetro = {{"robot", "htetro"}, {"wheels", "rollers"}};
  const Scenario dut = Read(RoomScenario(""), htetro);
  const Scenario ideal = Read(RoomScenario(""), {{"robot", "htetro"}});
  EXPECT_EQ(ideal.spec.episode.wheels, "ideal");
  EXPECT_THAT(ResolvedScenario(dut, folder_), HasSubstr("wheels: \"rollers\""));
  const auto bodies = [](const Scenario& s) {
    return BuildScene(s.world.site.map, s.world.robot, s.world.physics, s.world.start).model->nbody;
  };
  EXPECT_GE(bodies(dut), bodies(ideal) + 16 * 8);
  EXPECT_EQ(dut.world.robot.spec.mass_kg, ideal.world.robot.spec.mass_kg);
  EXPECT_THAT(Refusal(RoomScenario("", "wheels: rollers\n")),
              HasSubstr("wheels = rollers: must be ideal: the wheels of beluga have no rollers"));
  EXPECT_THAT(Refusal(RoomScenario("", "wheels: round\n")),
              HasSubstr("must be one of ideal, rollers"));
}

TEST_F(ScenarioFile, AFileThatChangedSinceIsNamed) {
  const Scenario first = Read(RoomScenario(""));
  std::filesystem::create_directories(folder_ / "out");
  WriteFileWhole(folder_ / "out" / "scenario.resolved.yaml",
                 ResolvedScenario(first, folder_ / "out"));
  Save("plan.csv", "x_m,y_m\n1.5,2.5\n3,2.6\n");
  try {
    ReadScenario(folder_ / "out" / "scenario.resolved.yaml", {}, Trust::kFull);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("plan.csv"));
    EXPECT_THAT(e.what(), HasSubstr("the file has changed since"));
  }
}

TEST_F(ScenarioFile, BadInputIsOneLineThatNamesTheRule) {
  EXPECT_THAT(Refusal("a: ["), HasSubstr("scenario.yaml:"));
  EXPECT_THAT(Refusal("scenario: 2\n"),
              HasSubstr("scenario.yaml:1: scenario = 2: must be in [1, 1]"));
  EXPECT_THAT(Refusal("site: x.yaml\n"), HasSubstr("scenario: the key is missing"));
  EXPECT_THAT(Refusal("scenario: 1\nsite: nothing.yaml\n"),
              HasSubstr("scenario.yaml:2: site = nothing.yaml: no such file"));
  EXPECT_THAT(Refusal(RoomScenario("", "robt: x\n")),
              HasSubstr("robt: unknown key; did you mean robot?"));
  EXPECT_THAT(Refusal(RoomScenario(""), {{"robot", "belug"}}), HasSubstr("did you mean beluga?"));
  EXPECT_THAT(Refusal(RoomScenario(""), {{"plan", "spirl"}}), HasSubstr("did you mean spiral?"));
  EXPECT_THAT(Refusal(RoomScenario(""), {{"plan", "{file: no.csv}"}}), HasSubstr("no such file"));
  EXPECT_THAT(Refusal(RoomScenario("", "start: {x_m: 0.2, y_m: 0.2}\n")),
              HasSubstr("lies in a wall"));
  EXPECT_THAT(Refusal(RoomScenario("", "start: {x_m: 99, y_m: 0}\n")),
              HasSubstr("lies off the map"));
  EXPECT_THAT(Refusal(RoomScenario("", "goal: {x_m: 99, y_m: 0}\n")),
              HasSubstr("lies off the map"));
  EXPECT_THAT(Refusal(RoomScenario("", "control_hz: 49\n")), HasSubstr("whole number of steps"));
  EXPECT_THAT(Refusal(RoomScenario("", "trace_hz: 33\n")), HasSubstr("must divide control_hz"));
  EXPECT_THAT(Refusal(RoomScenario("", "on_failure: stopp\n")), HasSubstr("did you mean stop?"));
  EXPECT_THAT(Refusal(RoomScenario("", "failures: {stuk: {}}\n")),
              HasSubstr("did you mean stuck?"));
  EXPECT_THAT(Refusal(RoomScenario("", "success: {min_coverage: 1.2}\n")),
              HasSubstr("success.min_coverage"));
  EXPECT_THAT(Refusal(RoomScenario("", "physics: {timestep_s: 0.1}\n")),
              HasSubstr("physics.timestep_s = 0.1"));
}

}  // namespace
}  // namespace floorproof
