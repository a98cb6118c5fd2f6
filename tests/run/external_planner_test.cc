// SPDX-License-Identifier: Apache-2.0
// Plans from programs that a scenario names: what they are told, what becomes of what they do.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "media/media.h"
#include "run/campaign/drive_campaign.h"
#include "run/campaign/episode_maker.h"
#include "run/episode/ask_program.h"
#include "run/episode/records.h"
#include "run/scenario/plan_file.h"
#include "run/scenario/resolved_scenario.h"
#include "run/scenario/scenario_file.h"
#include "tests/places.h"
#include "tests/run/scenario_text.h"
#include "tests/slurp.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

const std::string kSaysPlan = "printf 'x_m,y_m\\n1.5,2.5\\n3,2.5\\n' > \"$1\"/plan.csv\n";

class ExternalPlanner : public ScenarioTest {
 protected:
  // A scenario whose plan this shell script makes.
  std::string Asks(const std::string& script, const std::string& keys = "",
                   const std::string& more = "", const std::string& hazards = "") const {
    fs::permissions(Save("plan.sh", "#!/bin/sh\n" + script), fs::perms::owner_all);
    std::string text = RoomScenario(hazards, more);
    const std::string from = "{file: plan.csv}";
    return text.replace(text.find(from), from.size(), "{command: [./plan.sh]" + keys + "}");
  }
  PlanResult Plan(const std::string& script, const std::string& keys = "") const {
    return MakePlan(Read(Asks(script, keys)));
  }
  // How often the script was run that says so.
  long Asked() const {
    const std::string log = Slurp(folder_ / "log");
    return std::ranges::count(log, '\n');
  }
};

const std::string kLogs = "echo asked >> log\n";

TEST_F(ExternalPlanner, WhatItPlansIsDriven) {
  Scenario scenario = Read(Asks(kSaysPlan));
  const Execution dut = Execute(scenario);
  EXPECT_EQ(dut.plan.status, PlanStatus::kSuccess) << dut.plan.message;
  EXPECT_EQ(dut.plan.path.size(), 2u);
  EXPECT_EQ(dut.record.outcome, Outcome::kSuccess);
  EXPECT_NEAR(dut.record.trace.back().x_m, 3, 0.03);
  EXPECT_EQ(PlanJson(scenario, dut.plan)["planner"], "plan.sh");
}

TEST_F(ExternalPlanner, DrivesToItsPlansBeginFirst) {
  const PlanResult dut = Plan("printf 'x_m,y_m\\n3,2.5\\n' > \"$1\"/plan.csv");
  ASSERT_EQ(dut.path.size(), 2u) << dut.message;
  EXPECT_EQ(dut.path.front().p_W, Vec2(1.5, 2.5));
}

// The room is 9 m x 5 m, its start at the lower left.
TEST_F(ExternalPlanner, IsToldWhatAPlannerMayKnow) {
  const std::string hazards =
      "{type: step, id: sill, polygon_m: [[5, 1], [6, 1], [6, 2]], height_m: 0.05}, "
      "{type: rough, id: mat, polygon_m: [[7, 1], [8, 1], [8, 2]]}, "
      "{type: step, id: plank, polygon_m: [[3, 1], [4, 1], [4, 2]], height_m: 0.05, known: false}";
  const Scenario scenario =
      Read(Asks("cp \"$1\"/* .; " + kSaysPlan, "", "seed: 7\ngoal: {x_m: 4, y_m: 3}\n", hazards));
  const PlanResult plan = MakePlan(scenario);
  ASSERT_EQ(plan.status, PlanStatus::kSuccess) << plan.message;

  const auto dut = nlohmann::json::parse(Slurp(folder_ / "request.json"));
  EXPECT_EQ(dut["request"], 1);
  EXPECT_EQ(dut["seed"], 7);
  EXPECT_EQ(dut["start"], nlohmann::json::parse(R"({"x_m": 1.5, "y_m": 2.5, "yaw_rad": 0})"));
  EXPECT_EQ(dut["goal"], nlohmann::json::parse(R"({"x_m": 4, "y_m": 3})"));
  EXPECT_EQ(dut["robot"]["name"], "beluga");
  EXPECT_EQ(dut["robot"]["clear"]["circle_radius_m"], scenario.world.robot.spec.clear.radius_m);
  EXPECT_EQ(dut["robot"]["holonomic"], false);
  EXPECT_EQ(dut["robot"]["turns_on_the_spot"], true);
  ASSERT_EQ(dut["hazards"].size(), 2u) << "one is not known";
  EXPECT_EQ(dut["hazards"][0]["id"], "sill");
  EXPECT_EQ(dut["hazards"][0]["keep_off"], true);
  EXPECT_EQ(dut["hazards"][0]["height_m"], 0.05);
  EXPECT_EQ(dut["hazards"][0]["polygons_m"][0][1], nlohmann::json::parse("[6, 1]"));
  EXPECT_EQ(dut["hazards"][1]["keep_off"], false);
  EXPECT_THAT(Slurp(folder_ / "request.json"), Not(HasSubstr("plank")));

  const Image map = ReadImage(folder_ / "map.pgm"), reach = ReadImage(folder_ / "reach.pgm");
  EXPECT_EQ(map.data, ReadImage(folder_ / "map.png").data);
  EXPECT_EQ(reach.data, ReadImage(folder_ / "reach.png").data);
  const auto at = [&](const Image& image, const char* layer, double x_m, double y_m) {
    const auto& json = dut[layer];
    const double cell_m = json["cell_m"];
    EXPECT_EQ(json["width"], image.width);
    const int column = static_cast<int>(x_m / cell_m);
    const int row = image.height - 1 - static_cast<int>(y_m / cell_m);
    return int{image.data[static_cast<std::size_t>(row * image.width + column)]};
  };
  EXPECT_EQ(at(map, "map", 0.2, 0.2), dut["map"]["occupied"]);
  EXPECT_EQ(at(map, "map", 5.8, 1.2), dut["map"]["free"]) << "hazards are no walls";
  for (const auto& [x_m, y_m, yes] : {std::tuple(1.5, 2.5, true),
                                      {0.6, 0.6, false},  // beside a wall
                                      {5.8, 1.2, false},  // on what it keeps off
                                      {5.2, 1.8, true},   // the other half of its box
                                      {7.8, 1.2, true},   // on terrain
                                      {3.8, 1.2, true}})  // on what nobody knows of
    EXPECT_EQ(at(reach, "reach", x_m, y_m), dut["reach"][yes ? "yes" : "no"]) << x_m << ", " << y_m;

  EXPECT_EQ(Slurp(folder_ / "risk.csv"), RiskCsv(*plan.risk));
  EXPECT_EQ(dut["risk"]["cell_m"], plan.risk->grid.frame.cell_m);
}

// The page's example, on a ROS map that lies askew in the world.
TEST_F(ExternalPlanner, TheExampleCoversAFloorWhateverItsFrame) {
  constexpr int kWide = 60, kHigh = 40, kWall = 4;
  std::string pixels;
  for (int row = 0; row < kHigh; ++row)
    for (int column = 0; column < kWide; ++column) {
      const bool inside = row >= kWall && column >= kWall && row < kHigh - kWall &&
                          column < kWide - kWall && (row > 20 || column < 25 || column > 34);
      pixels += static_cast<char>(inside ? 254 : 0);
    }
  Save("map.pgm", "P5\n60 40\n255\n" + pixels);
  for (const char* origin : {"[0, 0, 0]", "[-3, 2, 0.6]", "[5, -1, -2.2]"}) {
    Save("map.yaml", std::string("image: map.pgm\nresolution: 0.05\norigin: ") + origin +
                         "\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n");
    std::string text = "scenario: 1\nsite: {site: 1, map: map.yaml}\nrobot: beluga\ndrive: none\n";
    text += "plan: {command: [python3, " + SourceFile("docs/examples/rows.py").string() + "]}\n";
    double x_m = 0, y_m = 0, yaw_rad = 0;
    ASSERT_EQ(std::sscanf(origin, "[%lf, %lf, %lf]", &x_m, &y_m, &yaw_rad), 3);
    const Vec2 start = Pose2{x_m, y_m, yaw_rad} * Vec2(0.5, 0.5);
    text += "start: {x_m: " + FormatDouble(start.x()) + ", y_m: " + FormatDouble(start.y()) + "}\n";
    const Scenario scenario = Read(text);
    const PlanResult dut = MakePlan(scenario);
    ASSERT_EQ(dut.status, PlanStatus::kSuccess) << dut.message;
    EXPECT_GT(PlanJson(scenario, dut)["coverage"].get<double>(), 0.9) << origin;
  }
}

TEST_F(ExternalPlanner, WhateverItDoesIsAnAnswer) {
  struct Case {
    std::string script, said;
  };
  const std::string csv = " > \"$1\"/plan.csv";
  for (const auto& [script, said] : {
           Case{"exit 3", "plan.sh ended with status 3"},
           {"echo ' first'; echo one >&2; echo; echo 'no floor' >&2; exit 1",
            "plan.sh ended with status 1: one / no floor"},
           {"kill -SEGV $$", "plan.sh was killed (Segmentation fault)"},
           {"sleep 1000", "plan.sh took more than 0.3 s (plan.timeout_s)"},
           {"printf 'not \\033[2J so' >&2; exit 1", "ended with status 1: not ?[2J so"},
           {"echo nothing to do >&2", "plan.sh wrote no plan.csv: nothing to do"},
           {":" + csv, "plan.sh gave a plan that cannot be driven: plan.csv:1: holds no waypoint"},
           {"printf 'x_m,y_m\\n1,nan\\n'" + csv, "plan.csv:2: y_m = nan: must be a finite"},
           {"printf 'x_m,y_m\\n1,1\\n40,1\\n'" + csv, "plan.csv:3: x_m, y_m = 40, 1: lies off"},
           {"printf 'x_m,y_m,shape\\n1,1,I\\n'" + csv, "changes the robot's shape (I)"},
           {"truncate -s 1G \"$1\"/plan.csv", "plan.csv: larger than 32 MiB"},
           {"mkdir \"$1\"/plan.csv", "plan.csv: is a folder"},
           {"mkfifo \"$1\"/plan.csv", "plan.csv: is a pipe"},
           {"ln -s /nowhere \"$1\"/plan.csv", "plan.csv: no such file"},
           {"rm -r \"$1\"", "plan.sh wrote no plan.csv"},
       }) {
    const bool too_long = said.find("0.3 s") != std::string::npos;
    Scenario scenario = Read(Asks(script, too_long ? ", timeout_s: 0.3" : ""));
    const Execution dut = Execute(scenario);
    EXPECT_EQ(dut.plan.status, PlanStatus::kFailed) << script;
    EXPECT_THAT(dut.plan.message, AllOf(StartsWith("plan.sh "), HasSubstr(said))) << script;
    EXPECT_THAT(dut.plan.message, Not(HasSubstr("/floorproof-"))) << "the same words each time";
    EXPECT_EQ(dut.record.outcome, Outcome::kNotPlanned);
    EXPECT_EQ(dut.record.message, dut.plan.message);
  }
}

TEST_F(ExternalPlanner, OneThatIsNotWhatWasReadIsRefused) {
  const Scenario scenario = Read(Asks(kSaysPlan));
  Save("plan.sh", "#!/bin/sh\nexit 0\n");
  EXPECT_THROW(MakePlan(scenario), InputError);
  fs::remove(folder_ / "plan.sh");
  EXPECT_THROW(MakePlan(scenario), InputError);
}

TEST_F(ExternalPlanner, WorksInTheScenariosFolderAndMayBeAnInterpretersScript) {
  Save("cover.sh", "cat rows.csv > \"$2\"/plan.csv; echo \"$1\" > said");
  Save("rows.csv", "x_m,y_m\n1.5,2.5\n2,2.5\n");
  std::string text = Asks("");
  const std::string from = "[./plan.sh]";
  text.replace(text.find(from), from.size(), "[sh, cover.sh, a b]");
  const Scenario scenario = Read(text);
  const PlanResult dut = MakePlan(scenario);
  EXPECT_EQ(dut.path.size(), 2u) << dut.message;
  EXPECT_EQ(Slurp(folder_ / "said"), "a b\n");
  EXPECT_EQ(scenario.spec.planner_name, "cover.sh");
  EXPECT_THAT(scenario.spec.plan_command->files, ElementsAre(folder_ / "cover.sh"));
  EXPECT_THAT(ProgramLine(*scenario.spec.plan_command),
              AllOf(StartsWith("runs a program that "), HasSubstr("scenario.yaml:"),
                    HasSubstr("names: sh cover.sh 'a b'")));
}

// What was driven can be driven again, wherever the folder goes, and nothing is run.
TEST_F(ExternalPlanner, ARecordedPlanStandsInForTheProgram) {
  const std::string random = "printf 'x_m,y_m\\n1.5,2.5\\n3,2.%d\\n' $$ > \"$1\"/plan.csv\n";
  const Scenario scenario = Read(Asks(kLogs + random));
  ASSERT_NE(ProgramToAsk(scenario.spec), nullptr);
  const PlanResult plan = MakePlan(scenario);
  ASSERT_EQ(plan.status, PlanStatus::kSuccess) << plan.message;
  WritePlanFiles(scenario, plan, folder_ / "out");
  fs::rename(folder_ / "out", folder_ / "moved");
  fs::remove(folder_ / "plan.sh");
  const fs::path resolved = folder_ / "moved" / "scenario.resolved.yaml";
  const Scenario again = ReadScenario(resolved);
  EXPECT_EQ(ProgramToAsk(again.spec), nullptr);
  EXPECT_EQ(PlanCsv(MakePlan(again).path), PlanCsv(plan.path));
  EXPECT_EQ(again.spec.planner_name, "plan.sh") << "who made it is still said";
  EXPECT_EQ(ResolvedScenario(again, folder_ / "moved"), Slurp(resolved));
  EXPECT_EQ(Asked(), 1);
}

TEST_F(ExternalPlanner, APlanThatIsNotTheRecordedOneIsRefused) {
  const Scenario scenario = Read(Asks(kSaysPlan));
  WritePlanFiles(scenario, MakePlan(scenario), folder_ / "out");
  for (const auto& entry : fs::directory_iterator(folder_ / "out" / "inputs"))
    std::ofstream(entry.path()) << "x_m,y_m\n1.5,2.5\n2,2\n";
  EXPECT_THROW(ReadScenario(folder_ / "out" / "scenario.resolved.yaml"), InputError);
}

TEST_F(ExternalPlanner, WithoutAPlanTheSettingsNameTheProgram) {
  const Scenario scenario = Read(Asks("exit 1", ", timeout_s: 5, uses_seed: true"));
  WritePlanFiles(scenario, MakePlan(scenario), folder_ / "out");
  const Scenario again = ReadScenario(folder_ / "out" / "scenario.resolved.yaml", {}, Trust::kFull);
  ASSERT_NE(ProgramToAsk(again.spec), nullptr);
  EXPECT_EQ(again.spec.plan_command->timeout_s, 5);
  EXPECT_TRUE(again.spec.plan_command->uses_seed);
  EXPECT_TRUE(fs::equivalent(again.spec.plan_command->folder, folder_))
      << again.spec.plan_command->folder;
  EXPECT_EQ(MakePlan(again).message, "plan.sh ended with status 1");
}

TEST_F(ExternalPlanner, SettingOneTakesAnotherWhosePlanAway) {
  Save("plan.csv", "x_m,y_m\n1.5,2.5\n3,2.5\n");
  const std::string asks = Asks(kSaysPlan), drives = RoomScenario("");
  EXPECT_NE(ProgramToAsk(Read(drives, {{"plan.command", "[./plan.sh]"}}).spec), nullptr);
  EXPECT_EQ(ProgramToAsk(Read(asks, {{"plan.file", "plan.csv"}}).spec), nullptr);
  EXPECT_EQ(Read(asks, {{"plan.planner", "spiral"}}).spec.planner_name, "spiral");
  EXPECT_EQ(Read(asks, {{"plan.timeout_s", "3"}}).spec.plan_command->timeout_s, 3);
}

TEST_F(ExternalPlanner, ACampaignAsksAnewWhenWhatItIsToldChanges) {
  const auto asked = [&](const std::string& keys, const std::string& more) {
    fs::remove(folder_ / "log");
    const ScenarioFile file(Save("s.yaml", Asks(kLogs + kSaysPlan, keys, "drive: none\n" + more)),
                            {}, Trust::kFull);
    EpisodeMaker dut(file);
    for (std::uint64_t episode = 0; episode < 4; ++episode)
      EXPECT_EQ(dut.Run({}, episode).outcome, "success");
    return Asked();
  };
  EXPECT_EQ(asked("", "randomise: {site.floor.friction: {uniform: [0.6, 1]}}\n"), 1);
  EXPECT_EQ(asked("", "randomise: {start.x_m: {uniform: [1, 2]}}\n"), 4);
  EXPECT_EQ(asked(", uses_seed: true", ""), 4);
}

TEST_F(ExternalPlanner, ItsSeedIsTheEpisodesOwnWhereItUsesOne) {
  const ScenarioFile plain(Save("p.yaml", Asks(kSaysPlan, "", "seed: 7\n")), {}, Trust::kFull),
      draws(Save("d.yaml", Asks(kSaysPlan, ", uses_seed: true", "seed: 7\n")));
  const auto seed = [](const ScenarioFile& file, std::uint64_t episode) {
    const Scenario s = file.Read(episode);
    return ProgramSeed(s.spec, *s.spec.plan_command);
  };
  EXPECT_EQ(seed(plain, 0), 7u);
  EXPECT_EQ(seed(plain, 1), 7u);
  EXPECT_NE(seed(draws, 0), seed(draws, 1));
  EXPECT_EQ(seed(draws, 1), seed(draws, 1));
}

}  // namespace
}  // namespace floorproof
