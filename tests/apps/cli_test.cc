// SPDX-License-Identifier: Apache-2.0
// The program as its users meet it: commands, files, exit statuses, one line for bad input.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "base/text_width.h"
#include "tests/apps/run_program.h"
#include "tests/own_folder.h"
#include "tests/places.h"
#include "tests/slurp.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

class Cli : public OwnFolderTest {
 protected:
  Cli() {
    std::ofstream(folder_ / "s.yaml") << R"(scenario: 1
site:
  site: 1
  grid:
    cell_m: 0.5
    rows: |
      ########
      #......#
      #......#
      #......#
      ########
  start: {x_m: 0.9, y_m: 0.9, yaw_deg: 30}
robot: beluga
plan: {planner: boustrophedon}
)";
  }

  Result Run(const std::string& arguments) const { return RunProgram(folder_, arguments); }
};

TEST_F(Cli, AProgramOfAnUntrustedScenarioIsNamedInTheRefusalAlone) {
  std::ofstream(folder_ / "p.sh") << "#!/bin/sh\necho asked >> log\n";
  fs::permissions(folder_ / "p.sh", fs::perms::owner_all);
  std::string text = Slurp(folder_ / "s.yaml");
  text.replace(text.find("{planner: boustrophedon}"), 24, "{command: [./p.sh, --fast]}");
  std::ofstream(folder_ / "s.yaml") << text;
  for (const std::string command :
       {"plan s.yaml", "run s.yaml", "campaign s.yaml -n 1 --set gate=none"}) {
    const Result dut = Run(command + " --out o");
    EXPECT_EQ(dut.status, 2) << command;
    EXPECT_THAT(dut.err, HasSubstr("plan.command = ./p.sh --fast: is a program that the scenario "
                                   "names: --trust runs it"));
    EXPECT_THAT(dut.out + dut.err, Not(HasSubstr("runs a program"))) << command;
    EXPECT_FALSE(fs::exists(folder_ / "log")) << command;
  }
}

// Neither is a program run that came in somebody's folder.
TEST_F(Cli, AProgramThatPlansIsNamedBeforeItIsRunAndNeverRunByReplay) {
  std::ofstream(folder_ / "p.sh") << "#!/bin/sh\necho asked >> log; cp there \"$1\"/plan.csv\n";
  fs::permissions(folder_ / "p.sh", fs::perms::owner_all);
  const std::string set = "s.yaml --set 'plan.command=[./p.sh]' --out o";
  const std::string line = "runs a program that --set plan.command names: ./p.sh\n";
  const Result none = Run("run " + set);
  EXPECT_EQ(none.status, 1);
  const std::size_t said = none.out.find(line), failed = none.out.find("no plan (failed): p.sh ");
  EXPECT_NE(said, std::string::npos) << none.out;
  EXPECT_NE(failed, std::string::npos) << none.out;
  EXPECT_LT(said, failed);
  const Result nothing = Run("replay o");
  EXPECT_EQ(nothing.status, 2);
  EXPECT_THAT(nothing.err, HasSubstr("made no plan"));
  EXPECT_EQ(Slurp(folder_ / "log"), "asked\n");

  std::ofstream(folder_ / "there") << "x_m,y_m\n1.5,1\n";
  EXPECT_THAT(Run("plan " + set).out, HasSubstr(line));
  EXPECT_EQ(Run("run " + set).status, 0);
  const Result again = Run("replay o");
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_THAT(again.out, Not(HasSubstr("runs a program")));
  EXPECT_EQ(Slurp(folder_ / "log"), "asked\nasked\nasked\n");
}

TEST_F(Cli, RunLeavesWhatTheContractNames) {
  const Result dut = Run("run s.yaml --out o");
  EXPECT_EQ(dut.status, 0) << dut.err << dut.out;
  for (const char* file : {"scenario.resolved.yaml", "plan.csv", "plan.json", "trace.csv",
                           "encounters.csv", "result.json", "heatmap_plan.png",
                           "heatmap_visits.png", "heatmap_coverage.png", "heatmap_failures.png"})
    EXPECT_TRUE(fs::exists(folder_ / "o" / file)) << file;
  for (const char* file :
       {"risk.csv", "heatmap_risk.png", "heatmap_plan_visits.png", "plot_risk.png"})
    EXPECT_FALSE(fs::exists(folder_ / "o" / file)) << file << ": nobody asked for risk";
  const auto result = nlohmann::json::parse(Slurp(folder_ / "o" / "result.json"));
  EXPECT_EQ(result["outcome"], "success");
  EXPECT_TRUE(result["events"].empty());
  EXPECT_EQ(result["versions"]["mujoco"], "4.0.1");
  EXPECT_THAT(Slurp(folder_ / "o" / "trace.csv"), HasSubstr("t_s,x_m,y_m,z_m,roll_rad"));
}

TEST_F(Cli, RunThatDrivesNothingLeavesThePlanAndItsPictures) {
  ASSERT_EQ(Run("run s.yaml --out o").status, 0);
  EXPECT_EQ(Run("run s.yaml --out o --set drive=none --set risk.distance_scale=1").status, 0);
  for (const char* file : {"plan.csv", "plan.json", "risk.csv", "heatmap_plan.png",
                           "heatmap_risk.png", "heatmap_plan_visits.png", "plot_risk.png"})
    EXPECT_TRUE(fs::exists(folder_ / "o" / file)) << file;
  for (const char* file : {"trace.csv", "result.json", "heatmap_visits.png"})
    EXPECT_FALSE(fs::exists(folder_ / "o" / file)) << file << " is an earlier run's";
}

TEST_F(Cli, APlanTakesThePlaceOfADrive) {
  ASSERT_LE(Run("run s.yaml --out o --set time_limit_s=1").status, 1);
  ASSERT_TRUE(fs::exists(folder_ / "o/result.json"));
  ASSERT_EQ(Run("plan s.yaml --out o").status, 0);
  for (const char* file : {"result.json", "trace.csv", "heatmap_visits.png"})
    EXPECT_FALSE(fs::exists(folder_ / "o" / file)) << file;
  EXPECT_TRUE(fs::exists(folder_ / "o/plan.csv"));
}

TEST_F(Cli, PlansOfOneFloorStandBesideEachOtherInOnePlot) {
  const auto plot = [&] { return Slurp(folder_ / "o" / "plot_risk.png"); };
  std::string text = Slurp(folder_ / "s.yaml");
  text.replace(text.find("boustrophedon"), 13, "path_transform");
  std::ofstream(folder_ / "t.yaml") << text;
  ASSERT_EQ(Run("plan s.yaml --out o --set risk.distance_scale=1").status, 0);
  const std::string alone = plot();
  ASSERT_EQ(Run("plan s.yaml --beside t.yaml --out o").status, 0);
  EXPECT_NE(plot(), alone);
  text.replace(text.find("#......#"), 8, "#.....##");
  std::ofstream(folder_ / "u.yaml") << text;
  const Result dut = Run("plan s.yaml --beside t.yaml u.yaml --out o");
  EXPECT_EQ(dut.status, 2);
  EXPECT_THAT(dut.err, HasSubstr("u.yaml"));
  EXPECT_THAT(dut.err, HasSubstr("another floor"));
}

// The same bytes in every file: run twice, run from the resolved file, replayed.
TEST_F(Cli, TheResolvedScenarioGivesTheSameBytes) {
  ASSERT_EQ(Run("run s.yaml --out a").status, 0);
  ASSERT_EQ(Run("run s.yaml --out b").status, 0);
  fs::create_directories(folder_ / "c");
  ASSERT_EQ(Run("run a/scenario.resolved.yaml --out c").status, 0);
  for (const char* file : {"plan.csv", "plan.json", "trace.csv", "heatmap_visits.png"}) {
    EXPECT_EQ(Slurp(folder_ / "a" / file), Slurp(folder_ / "b" / file)) << file;
    EXPECT_EQ(Slurp(folder_ / "a" / file), Slurp(folder_ / "c" / file)) << file;
  }
  for (const char* file : {"scenario.resolved.yaml", "result.json"}) {
    EXPECT_EQ(Slurp(folder_ / "a" / file), Slurp(folder_ / "b" / file)) << file;
    EXPECT_EQ(Slurp(folder_ / "a" / file), Slurp(folder_ / "c" / file)) << file;
  }
  EXPECT_EQ(Run("replay a").status, 0);
}

// mean_estimate_position_std_m was mean_estimate_spread_m.
TEST_F(Cli, ARecordWithAMetricsFormerNameIsReplayed) {
  ASSERT_EQ(Run("run s.yaml --out a").status, 0);
  std::string result = Slurp(folder_ / "a" / "result.json");
  const std::string name = "mean_estimate_position_std_m";
  ASSERT_NE(result.find(name), std::string::npos);
  result.replace(result.find(name), name.size(), "mean_estimate_spread_m");
  std::ofstream(folder_ / "a" / "result.json") << result;
  const Result dut = Run("replay a");
  EXPECT_EQ(dut.status, 0) << dut.err;
}

TEST_F(Cli, AReplayThatDiffersFromTheRecordSaysSo) {
  ASSERT_EQ(Run("run s.yaml --out a").status, 0);
  auto result = nlohmann::ordered_json::parse(Slurp(folder_ / "a" / "result.json"));
  result["metrics"]["duration_s"] = 1.0;
  std::ofstream(folder_ / "a" / "result.json") << result.dump(2);
  const Result dut = Run("replay a");
  EXPECT_EQ(dut.status, 3);
  EXPECT_THAT(dut.err, HasSubstr("the replay differs from the record in 'metrics'"));
}

TEST_F(Cli, AnOutcomeThatIsNoSuccessIsExitStatusOne) {
  EXPECT_EQ(Run("run s.yaml --out o --set time_limit_s=2").status, 1);
  EXPECT_EQ(Run("run s.yaml --out p --set plan=path_transform --set goal.x_m=2.25 --set "
                "goal.y_m=1.25 --set 'site.hazards=[{type: blind_object, polygon_m: [[2,1],[2.5,1],"
                "[2.5,1.5],[2,1.5]]}]'")
                .status,
            1)
      << "the goal lies in a hazard";
  EXPECT_EQ(nlohmann::json::parse(Slurp(folder_ / "p" / "plan.json"))["status"],
            "goal_unreachable");
  EXPECT_EQ(nlohmann::json::parse(Slurp(folder_ / "p" / "result.json"))["outcome"], "not_planned");
}

// `run` and `plan` warn alike of corners that the robot cannot turn; `plan` of a plan that is too
// little.
TEST_F(Cli, WhatIsWrongWithAUsersPlanIsSaidBeforeTheDrive) {
  std::ofstream(folder_ / "plan.csv") << "x_m,y_m\n1.1,1.1\n2,1.1\n2,1.5\n";
  const std::string to =
      " s.yaml --out o --set robot=scrubber --set 'plan={file: plan.csv}' "
      "--set 'start={x_m: 1.1, y_m: 1.1}' --set time_limit_s=0.5";
  constexpr const char* kWarning = "warning: the plan has 1 corner too sharp for the robot, which ";
  EXPECT_THAT(Run("plan" + to).out, HasSubstr(kWarning));
  constexpr const char* kTooLittle = "warning: success.min_coverage asks for 90 %";
  EXPECT_THAT(Run("plan" + to + " --set success.min_coverage=0.9").out, HasSubstr(kTooLittle));
  EXPECT_THAT(Run("plan" + to + " --set success.min_coverage=0").out, Not(HasSubstr(kTooLittle)));
  const Result dut = Run("run" + to);
  EXPECT_THAT(dut.out, HasSubstr(kWarning));
  EXPECT_THAT(Run("run" + to + " --set robot=beluga").out, Not(HasSubstr("too sharp")));
}

// A plan that cuts through a wall, one that keeps off, and one that leaves half of the room.
TEST_F(Cli, APlanIsJudgedStrictlyOnDemand) {
  const auto plan = [&](const std::string& rows, const std::string& more) {
    std::ofstream(folder_ / "plan.csv") << "x_m,y_m\n0.9,0.9\n" << rows;
    return Run("--json plan s.yaml --out o --set 'plan={file: plan.csv}' " + more);
  };
  const auto faults = [&](const std::string& rows) {
    return nlohmann::json::parse(plan(rows, "").out)["faults"].dump();
  };
  const std::string into_wall = "0.9,0.3\n", short_way = "1.5,0.9\n";
  EXPECT_EQ(faults(into_wall), R"(["overlap","gap"])");
  EXPECT_EQ(faults(short_way), R"(["gap"])");
  EXPECT_EQ(plan(into_wall, "").status, 0) << "a warning is no error";
  EXPECT_EQ(plan(into_wall, "--strict").status, 1);
  EXPECT_EQ(plan(into_wall, "--strict --allow gap").status, 1);
  EXPECT_EQ(plan(into_wall, "--strict --allow gap,overlap").status, 0);
  EXPECT_EQ(plan(short_way, "--strict").status, 1);
  EXPECT_EQ(plan(short_way, "--strict --set success.min_coverage=0").status, 0) << "none is asked";
  EXPECT_EQ(plan(short_way, "--strict --allow gap").status, 0);
  EXPECT_EQ(plan(short_way, "--strict --allow gap --set success.min_coverage=0.9").status, 1);
  const Result unknown = plan(short_way, "--strict --allow gaps");
  EXPECT_EQ(unknown.status, 2);
  EXPECT_THAT(unknown.err, HasSubstr("--allow: gaps: unknown fault"));
  EXPECT_THAT(plan(short_way, "--allow gap").err,
              HasSubstr("--allow: gap: accepts faults of --strict alone"));
}

TEST_F(Cli, AStartInAWallIsBadInput) {
  const Result dut = Run("run s.yaml --out p --set start.x_m=0.52 --set start.y_m=0.52");
  EXPECT_EQ(dut.status, 2);
  EXPECT_THAT(dut.err, HasSubstr("start = 0.52, 0.52: beluga at this heading overlaps a wall"));
  EXPECT_FALSE(fs::exists(folder_ / "p"));
}

TEST_F(Cli, JsonGoesToStdoutAlone) {
  const Result dut = Run("--json plan s.yaml --out o");
  EXPECT_EQ(dut.status, 0);
  EXPECT_EQ(nlohmann::json::parse(dut.out)["status"], "success");
}

TEST_F(Cli, WhatCannotBeSaidIsAnError) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  for (const char* arguments : {"--json list >/dev/full", "list >/dev/full",
                                "run s.yaml --out o --json >/dev/full", "--help >/dev/full"}) {
    const Result dut = Run(arguments);
    EXPECT_EQ(dut.status, 3) << arguments;
    EXPECT_THAT(dut.err, HasSubstr("stdout cannot be written")) << arguments;
  }
  EXPECT_TRUE(fs::exists(folder_ / "o" / "result.json"));
}

TEST_F(Cli, AReaderThatGoesAwayCostsNoFile) {
  Run("run s.yaml --out o | true");
  for (const char* file : {"result.json", "trace.csv", "plot_errors.png"})
    EXPECT_TRUE(fs::exists(folder_ / "o" / file)) << file;
}

TEST_F(Cli, AUsersFilesAreNotWrittenOver) {
  std::ofstream(folder_ / "plan.csv") << "x_m,y_m\n0.9,0.9\n2,0.9\n";
  const std::string mine = Slurp(folder_ / "plan.csv");
  const Result dut = Run("run s.yaml --out . --set 'plan={file: plan.csv}'");
  EXPECT_EQ(dut.status, 2);
  EXPECT_THAT(dut.err, HasSubstr("plan.csv: is read"));
  EXPECT_EQ(Slurp(folder_ / "plan.csv"), mine);
  fs::create_directories(folder_ / "o");
  std::ofstream(folder_ / "o" / "video.mp4") << "my own";
  EXPECT_EQ(Run("run s.yaml --out o").status, 2);
  EXPECT_EQ(Slurp(folder_ / "o" / "video.mp4"), "my own");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "o"), {}), 1);
  fs::remove(folder_ / "o" / "video.mp4");
  for (int i = 0; i < 2; ++i) EXPECT_EQ(Run("run s.yaml --out o").status, 0) << "its own";
  EXPECT_EQ(Run("scene s.yaml --out s.yaml").status, 2);
  for (const char* others : {"notes.xml", "link.xml"}) {
    std::ofstream(folder_ / "notes.xml") << "<mujoco/>";
    fs::create_symlink("notes.xml", folder_ / "link.xml");
    const Result scene = Run(std::string("scene s.yaml --out ") + others);
    EXPECT_EQ(scene.status, 2);
    EXPECT_THAT(scene.err, HasSubstr(std::string(others) + ": is not a file that `scene` wrote"));
    EXPECT_EQ(Slurp(folder_ / "notes.xml"), "<mujoco/>");
    fs::remove(folder_ / "link.xml");
  }
  for (int i = 0; i < 2; ++i) EXPECT_EQ(Run("scene s.yaml --out its_own.xml").status, 0);
}

// A run and a campaign of one scenario: neither replaces what the other left.
TEST_F(Cli, RunsAndCampaignsKeepApart) {
  const std::string text = Slurp(folder_ / "s.yaml") + "name: hall\ndrive: none\n";
  fs::create_directories(folder_ / "a");
  for (const char* file : {"scenario.yaml", "a/wet.yaml", "dry.yaml"})
    std::ofstream(folder_ / file) << text;
  const std::pair<std::string, std::string> cases[] = {
      {"plan scenario.yaml", "out/hall"},
      {"run scenario.yaml", "out/hall"},
      {"campaign scenario.yaml -n 1", "out/hall/campaign"},
      {"plan scenario.yaml", "out/hall"},
      {"campaign a/wet.yaml -n 1", "out/wet"},
      {"run '" + folder_.string() + "/a/wet.yaml'", "out/wet/run"},
      {"plan dry.yaml", "out/dry"},
  };
  for (const auto& [command, out] : cases) {
    const Result dut = Run(command);
    EXPECT_EQ(dut.status, 0) << command << dut.err;
    EXPECT_THAT(dut.out, HasSubstr("  Results             " + out + "\n")) << command;
    EXPECT_TRUE(fs::exists(folder_ / out / "scenario.resolved.yaml")) << command;
    if (command.starts_with("campaign")) {
      EXPECT_THAT(dut.out, HasSubstr("  Page                " + out + "/report.html\n"));
      EXPECT_THAT(Slurp(folder_ / out / "files.sha256"), HasSubstr("  report.html\n"));
    }
  }
  const std::string settings = Slurp(folder_ / "out/wet/scenario.resolved.yaml");
  for (const std::string command : {"run", "plan"}) {
    const Result dut = Run(command + " dry.yaml --out out/wet");
    EXPECT_EQ(dut.status, 2);
    EXPECT_THAT(dut.err, HasSubstr("out/wet: holds a campaign"));
  }
  EXPECT_EQ(Slurp(folder_ / "out/wet/scenario.resolved.yaml"), settings);
  const Result dut = Run("campaign dry.yaml -n 1 --out out/dry");
  EXPECT_EQ(dut.status, 2);
  EXPECT_THAT(dut.err, HasSubstr("out/dry: holds a plan or a run"));
}

TEST_F(Cli, APlanThatIsSetTakesThePlaceOfThePlanner) {
  fs::create_directories(folder_ / "mine");
  std::ofstream(folder_ / "p.csv") << "x_m,y_m\n0.9,0.9\n2.345,0.9\n";
  for (const char* plan :
       {"boustrophedon", "{planner: boustrophedon, overlap: 0.1}", "{file: other.csv}"}) {
    std::string text = Slurp(folder_ / "s.yaml");
    text.replace(text.find("plan: "), std::string::npos, std::string("plan: ") + plan + "\n");
    std::ofstream(folder_ / "mine/t.yaml") << text;
    for (const char* set : {"plan.file=p.csv", "'plan={file: p.csv}'", "plan.file=../p.csv"}) {
      const Result dut = Run(std::string("plan mine/t.yaml --out o --set ") + set);
      EXPECT_EQ(dut.status, 0) << plan << " " << set << ": " << dut.err;
      EXPECT_THAT(Slurp(folder_ / "o/plan.csv"), HasSubstr("2.345"));
    }
    EXPECT_EQ(Run("plan mine/t.yaml --out o --set plan.planner=spiral").status, 0) << plan;
    EXPECT_THAT(Slurp(folder_ / "o/plan.csv"), Not(HasSubstr("2.345")));
  }
  std::ofstream(folder_ / "both.yaml") << [&] {
    std::string text = Slurp(folder_ / "s.yaml");
    return text.replace(text.find("plan: "), std::string::npos,
                        "plan: {planner: spiral, file: p.csv}\n");
  }();
  EXPECT_THAT(Run("plan both.yaml").err,
              HasSubstr("a plan is either made by a planner or read from a file"));
}

TEST_F(Cli, NamesFromFilesNeverReachTheTerminalRaw) {
  std::ofstream(folder_ / "a\x1b[2J\xff.yaml") << Slurp(folder_ / "s.yaml") << "drive: none\n";
  const Result dut = Run("run a*.yaml --json");
  EXPECT_EQ(dut.status, 0) << dut.err;
  for (const std::string& text : {dut.out, dut.err})
    EXPECT_EQ(text.find_first_of("\x1b\xff"), std::string::npos) << text;
  EXPECT_EQ(nlohmann::json::parse(dut.out)["scenario"], "a?[2J?");
}

TEST_F(Cli, BadInputIsOneLineAndStatusTwo) {
  std::ofstream(folder_ / "bad.yaml") << "scenario: 1\nsite: s.yaml\nrobt: beluga\n";
  std::ofstream(folder_ / "site.yaml") << "site: 1\nmap: map.yaml\n";
  std::ofstream(folder_ / "map.yaml") << "image: map.pgm\nresolution: 0.05\n";
  std::ofstream(folder_ / "list.yaml") << "- scenario\n";
  std::ofstream(folder_ / "map.pgm") << "P5 2 2 255\nabcd";
  std::ofstream(folder_ / "p.csv") << "x_m,y_m\n0.9,0.9\n2,0.9\n";
  std::ofstream(folder_ / "drawn.yaml")
      << "start: {x_m: 2, y_m: 0.9}\nrandomise:\n  start.x_m: {choice: [0.52]}\n"
      << Slurp(folder_ / "s.yaml");
  std::ofstream(folder_ / "binary.yaml") << std::string("\0\1\2\xff", 4);
  const std::pair<const char*, const char*> cases[] = {
      {"run missing.yaml", "missing.yaml: no such file"},
      {"run bad.yaml", "bad.yaml:3: robt: unknown key; did you mean robot?"},
      {"run binary.yaml", "not a text file"},
      {"run .", "not a file"},
      {"run s.yaml --set robot=belug", "did you mean beluga?"},
      {"run s.yaml --set robt:1", "--set: robt:1: must be KEY=VALUE, as in --set robot=htetro"},
      {"run s.yaml --set control_hz=0", "control_hz = 0: must be in [1, 2000]"},
      {"run s.yaml --out s.yaml", "a file is in the way"},
      {"run s.yaml --seed -1", "floorproof:"},
      {"rum s.yaml", "floorproof:"},
      {"", "floorproof:"},
      {"list planers", "floorproof:"},
      {"replay .", "not a folder of a finished `run`"},
      {"init missing.yaml", "missing.yaml"},
      {"init map.pgm", "map.pgm: is the map's image: name its .yaml"},
      {"init site.yaml", "site.yaml: is a site, not a ROS map: name the map's own .yaml"},
      {"init s.yaml", "s.yaml: is a scenario, not a ROS map: name the map's own .yaml"},
      {"run s.yaml --set site=s.yaml", "s.yaml: is a scenario, not a site"},
      {"run s.yaml --set site=map.yaml", "map.yaml: is a ROS map, not a site: a site names it"},
      {"run site.yaml", "site.yaml: is a site, not a scenario: a scenario names it"},
      {"run list.yaml", "list.yaml:1: must be a map of keys (scenario: 1,"},
      {"run s.yaml --set start.x_m=1000", "--set start.x_m:1: start = 1000, 0.9: lies off the map"},
      {"run s.yaml --set goal.y_m=-7", "--set goal.y_m:1: goal = 0, -7: lies off the map"},
      {"run drawn.yaml --set start.y_m=-9", "--set start.y_m:1: start = 0.52, -9: lies off"},
      {"run drawn.yaml", "drawn.yaml:3: start = 0.52, 0.9: beluga at this heading overlaps"},
      {"run s.yaml --set plan.overlap=0 --set plan.file=p.csv", "plan.overlap: unknown key"},
      {"scene s.yaml --out /nonexistent/x.xml", "/nonexistent/x.xml: cannot be written"},
  };
  for (const auto& [arguments, message] : cases) {
    const Result dut = Run(arguments);
    EXPECT_EQ(dut.status, 2) << arguments;
    EXPECT_THAT(dut.err, HasSubstr(message)) << arguments;
    EXPECT_EQ(std::count(dut.err.begin(), dut.err.end(), '\n'), 1) << arguments << ": " << dut.err;
  }
}

TEST_F(Cli, ListNamesThePlugInsAndTheirKeys) {
  const Result all = Run("list"), planners = Run("list planners");
  EXPECT_EQ(all.status, 0);
  for (const char* name :
       {"boustrophedon", "spiral", "regulated_pursuit", "truth", "beluga", "step", "veer_off"})
    EXPECT_THAT(all.out, HasSubstr(name));
  EXPECT_THAT(planners.out, HasSubstr("overlap"));
  EXPECT_THAT(planners.out, Not(HasSubstr("beluga")));
  EXPECT_THAT(Run("list hazards").out,
              ::testing::AllOf(HasSubstr("line_m"), HasSubstr("polygon_m")));
  const Result json = Run("--json list hazards");
  EXPECT_THAT(json.out, HasSubstr("\"place\": \"line_m\""));
}

TEST_F(Cli, SchemasArePrintedAsJson) {
  for (const std::string kind : {"site", "scenario"}) {
    const Result dut = Run("schema " + kind);
    EXPECT_EQ(dut.status, 0);
    const auto schema = nlohmann::json::parse(dut.out);
    EXPECT_EQ(schema["$schema"], "http://json-schema.org/draft-07/schema#");
    EXPECT_EQ(schema["properties"][kind]["const"], 1);
    EXPECT_EQ(schema["additionalProperties"], false);
    EXPECT_EQ(Run("--json --quiet schema " + kind).out, dut.out);
  }
}

TEST_F(Cli, EachCommandExplainsItself) {
  for (const char* command :
       {"demo", "init", "plan", "run", "replay", "scene", "list", "schema", "doctor"}) {
    const Result dut = Run(std::string(command) + " --help");
    EXPECT_EQ(dut.status, 0);
    EXPECT_THAT(dut.out, HasSubstr(command));
    for (const char* global : {"--set", "--json", "--quiet"})
      EXPECT_THAT(dut.out, HasSubstr(global)) << command;
  }
  EXPECT_EQ(Run("--version").status, 0);
}

TEST_F(Cli, InitWritesARunnableScenarioAndLeavesExistingFiles) {
  std::string pgm = "P5 60 40 255\n";
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 60; ++x)
      pgm += x < 2 || y < 2 || x > 57 || y > 37 ? '\0' : static_cast<char>(254);
  std::ofstream(folder_ / "map.pgm", std::ios::binary) << pgm;
  std::ofstream(folder_ / "map.yaml")
      << "image: map.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: "
         "0.65\nfree_thresh: 0.196\n";
  ASSERT_EQ(Run("init map.yaml --out mine").status, 0);
  EXPECT_EQ(Run("run mine/scenario.yaml --out o").status, 0);
  EXPECT_EQ(Run("init map.yaml --out mine").status, 0) << "the same again";
  // What it says to drive next is what it was asked for.
  fs::copy_file(folder_ / "map.yaml", folder_ / "other.yaml");
  for (const std::string command : {"init other.yaml", "init map.yaml --robot htetro"}) {
    const Result dut = Run(command + " --out mine");
    EXPECT_EQ(dut.status, 2) << command;
    EXPECT_THAT(dut.err, HasSubstr("is there already, changed or of another map or robot"));
  }
  std::ofstream(folder_ / "mine" / "site.yaml") << "mine";
  EXPECT_EQ(Run("init map.yaml --out mine").status, 2);
  EXPECT_EQ(Slurp(folder_ / "mine" / "site.yaml"), "mine");

  // What is driven is what was drawn, and said; what is set is not drawn.
  for (const std::string command : {"run", "plan"}) {
    const std::string set = command + " mine3/scenario.yaml --out d --set drive=none";
    ASSERT_EQ(Run("init map.yaml --out mine3").status, 0);
    EXPECT_THAT(Run(set).out, HasSubstr("  Drawn               site.floor.friction 0."));
    EXPECT_THAT(Run(set + " --set site.floor.friction=0.7").out,
                ::testing::AllOf(HasSubstr("  Drawn  "), Not(HasSubstr("site.floor.friction"))));
  }

  // A map is found from the current folder, and without draws nothing is said of any.
  fs::create_directories(folder_ / "maps");
  for (const char* file : {"map.yaml", "map.pgm"})
    fs::copy_file(folder_ / file, folder_ / "maps" / file);
  const Result set =
      Run("plan mine3/scenario.yaml --out d --set site.map=maps/map.yaml "
          "--set randomise=none");
  EXPECT_EQ(set.status, 0) << set.err;
  EXPECT_THAT(set.out, Not(HasSubstr("drawn by")));
  EXPECT_THAT(Slurp(folder_ / "d/scenario.resolved.yaml"), HasSubstr("map: \"../maps/map.yaml\""));

  // A map that stands where a scenario should.
  for (const std::string command : {"run", "plan", "campaign -n 3"}) {
    const auto refused = Run(command + " map.yaml");
    EXPECT_EQ(refused.status, 2) << command;
    EXPECT_THAT(refused.err, HasSubstr("`floorproof init map.yaml`")) << command;
  }
  // And its image: it is the map that one sees. What is no text is the same in any size.
  fs::copy_file(folder_ / "map.pgm", folder_ / "lone.pgm");
  std::ofstream(folder_ / "big.png") << "\x89PNG" << std::string(4 << 20, '\xff');
  std::ofstream(folder_ / "of_image.yaml") << "scenario: 1\nsite: map.pgm\nrobot: beluga\n";
  const std::pair<const char*, const char*> images[] = {
      {"run map.pgm", "map.pgm: is an image, not a scenario: `floorproof init map.yaml`"},
      {"plan map.pgm", "map.pgm: is an image, not a scenario: `floorproof init map.yaml`"},
      {"campaign lone.pgm -n 3", "lone.pgm: is an image, not a scenario: `floorproof init MAP.y"},
      {"scene big.png --out x", "big.png: is an image, not a scenario: `floorproof init MAP.yaml`"},
      {"run of_image.yaml", "map.pgm: is an image, not a site: `floorproof init map.yaml` writes"},
      {"plan mine3/scenario.yaml --set site=map.pgm", "map.pgm: is an image, not a site: `floor"}};
  for (const auto& [command, why] : images) {
    const auto refused = Run(command);
    EXPECT_EQ(refused.status, 2) << command;
    EXPECT_THAT(refused.err, HasSubstr(why)) << command;
  }

  // A map that an untrusted scenario could not read is copied.
  fs::create_directories(folder_ / "mine4/.maps");
  for (const char* file : {"map.yaml", "map.pgm"})
    fs::copy_file(folder_ / file, folder_ / "mine4/.maps" / file);
  ASSERT_EQ(Run("init mine4/.maps/map.yaml --out mine4").status, 0);
  EXPECT_THAT(Slurp(folder_ / "mine4/site.yaml"), HasSubstr("map: \"map.yaml\""));
  EXPECT_EQ(Run("plan mine4/scenario.yaml --out own").status, 0);

  // A map may not make it read what lies elsewhere.
  fs::create_directories(folder_ / "mine5");
  std::ofstream(folder_ / "mine5/map.yaml")
      << "image: " << (folder_ / "map.pgm").string()
      << "\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\n"
         "free_thresh: 0.196\n";
  EXPECT_THAT(Run("init mine5/map.yaml --out mine6").err,
              AllOf(HasSubstr("mine5/map.yaml:1: image = "), HasSubstr("outside the map's folder"),
                    HasSubstr("--trust")));
  EXPECT_EQ(Run("init mine5/map.yaml --out mine6 --trust").status, 0);

  // A robot of one's own, named from where one is; and what two maps give does not meet.
  fs::create_directories(folder_ / "mine2/robots");
  fs::copy_file(SourceFile("models/beluga.xml"), folder_ / "my.xml");
  fs::rename(folder_ / "map.yaml", folder_ / "hall.yaml");
  ASSERT_EQ(Run("init hall.yaml --robot my.xml --out mine2").status, 0);
  EXPECT_THAT(Slurp(folder_ / "mine2/scenario.yaml"), HasSubstr("robot: \"robot/my.xml\""));
  EXPECT_EQ(Run("plan mine2/scenario.yaml").status, 0);
  EXPECT_TRUE(fs::exists(folder_ / "out/hall/plan.csv"));
  EXPECT_EQ(Run("plan mine2/scenario.yaml --set robot=my.xml --out set").status, 0);
  const auto missing = Run("plan mine2/scenario.yaml --set robot=none.xml");
  EXPECT_EQ(missing.status, 2);
  const std::string here = fs::weakly_canonical(folder_).string();
  EXPECT_THAT(missing.err, HasSubstr("robot = none.xml: no such file: " + here + "/none.xml, nor " +
                                     here + "/mine2/none.xml"));
  EXPECT_THAT(Run("plan mine2/scenario.yaml --set robot=/none.xml").err,
              HasSubstr("no such file: /none.xml\n"));
}

// Of a program on a terminal. What it writes there, carriage returns and all.
std::string OnATerminal(const fs::path& folder, const std::vector<std::string>& arguments,
                        int columns = 80, const char* no_color = nullptr) {
  winsize window{};
  window.ws_row = 24;
  window.ws_col = static_cast<unsigned short>(columns);
  int terminal = -1;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, &window);
  if (child == 0) {
    setenv("TERM", "xterm", 1);
    unsetenv("NO_COLOR");
    if (no_color != nullptr) setenv("NO_COLOR", no_color, 1);
    std::string program = ProgramFile().string();
    std::vector<char*> argv = {program.data()};
    for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
    argv.push_back(nullptr);
    if (chdir(folder.c_str()) == 0) execv(program.c_str(), argv.data());
    _exit(127);
  }
  std::string seen;
  std::array<char, 4096> buffer;
  for (ssize_t n; (n = read(terminal, buffer.data(), buffer.size())) > 0;)
    seen.append(buffer.data(), static_cast<std::size_t>(n));
  close(terminal);
  int code = 0;
  waitpid(child, &code, 0);
  EXPECT_TRUE(WIFEXITED(code));
  return seen;
}

TEST_F(Cli, ARobotIsCheckedAndDrawn) {
  const Result dut = Run("robot beluga --json");
  EXPECT_EQ(dut.status, 0) << dut.err;
  EXPECT_THAT(dut.err, HasSubstr("nothing is wrong with it"));
  const auto json = nlohmann::json::parse(dut.out);
  EXPECT_EQ(json["drive"], "differential");
  EXPECT_TRUE(json["ok"]);
  const std::string picture = Slurp(folder_ / "out/robot/beluga.robot.png");
  EXPECT_EQ(picture.substr(1, 3), "PNG");
  EXPECT_EQ(Run("robot beluga --quiet --out mine/b.xml").status, 0);
  EXPECT_EQ(Slurp(folder_ / "mine/b.robot.png"), picture) << "the same bytes, wherever it goes";
}

TEST_F(Cli, ARobotThatIsNotAsItShouldBeEndsWithOne) {
  std::string mjcf = Slurp(SourceFile("models/beluga.xml"));
  const std::string speed = "name=\"max_speed_mps\" data=\"0.40\"";
  mjcf.replace(mjcf.find(speed), speed.size(), "name=\"max_speed_mps\" data=\"0.90\"");
  std::ofstream(folder_ / "fast.xml") << mjcf;
  const Result dut = Run("robot fast.xml");
  EXPECT_EQ(dut.status, 1) << dut.err;
  EXPECT_THAT(dut.out, HasSubstr("wrong: max_speed_mps 0.9 is more than the motors reach"));
  EXPECT_TRUE(fs::exists(folder_ / "out/robot/fast.robot.png"));
  EXPECT_EQ(Run("robot no.xml").status, 2);
  EXPECT_EQ(Run("robot beluga --out b.png").status, 2);
  std::ofstream(folder_ / "out/robot/beluga.robot.png") << "somebody's";
  const Result foreign = Run("robot beluga");
  EXPECT_EQ(foreign.status, 2);
  EXPECT_EQ(Slurp(folder_ / "out/robot/beluga.robot.png"), "somebody's");
}

// A URDF: its MJCF, every guess marked, which then drives a scenario.
TEST_F(Cli, AUrdfBecomesARobot) {
  std::ofstream(folder_ / "my.urdf") << R"(<robot name="my">
<link name="base"><inertial><mass value="6"/><origin xyz="-0.02 0 0.08"/>
 <inertia ixx="0.05" iyy="0.06" izz="0.08" ixy="0" ixz="0" iyz="0"/></inertial>
 <collision><origin xyz="-0.02 0 0.08"/><geometry><box size="0.3 0.2 0.1"/></geometry></collision>
 <collision><origin xyz="-0.14 0 0.015"/><geometry><sphere radius="0.015"/></geometry></collision></link>
<link name="l"><collision><geometry><cylinder radius="0.05" length="0.02"/></geometry></collision></link>
<link name="r"><collision><geometry><cylinder radius="0.05" length="0.02"/></geometry></collision></link>
<joint name="left" type="continuous"><parent link="base"/><child link="l"/>
 <origin xyz="0 0.12 0.05" rpy="-1.5707963267948966 0 0"/><axis xyz="0 0 1"/></joint>
<joint name="right" type="continuous"><parent link="base"/><child link="r"/>
 <origin xyz="0 -0.12 0.05" rpy="-1.5707963267948966 0 0"/><axis xyz="0 0 1"/></joint>
</robot>)";
  const Result dut = Run("robot my.urdf --out my.xml --set cruise_mps=0.3");
  EXPECT_EQ(dut.status, 0) << dut.out << dut.err;
  EXPECT_THAT(dut.out, HasSubstr("my.xml written: each guess in it is marked as one"));
  const std::string mjcf = Slurp(folder_ / "my.xml");
  EXPECT_THAT(mjcf, HasSubstr("<numeric name=\"cruise_mps\" data=\"0.3\"/>  <!-- given -->"));
  EXPECT_THAT(mjcf, HasSubstr("<!-- guess: "));
  EXPECT_TRUE(fs::exists(folder_ / "my.robot.png"));
  EXPECT_EQ(Run("run s.yaml --out o --set robot=my.xml").status, 0);

  EXPECT_EQ(Run("robot my.urdf --out my.xml").status, 0) << "its own is written again";
  EXPECT_THAT(Slurp(folder_ / "my.xml"), Not(HasSubstr("<!-- given -->")));
  std::ofstream(folder_ / "my.xml", std::ios::app) << "<!-- weighed -->";
  const std::string changed = Slurp(folder_ / "my.xml");
  const Result again = Run("robot my.urdf --out my.xml");
  EXPECT_EQ(again.status, 2);
  EXPECT_THAT(again.err, HasSubstr("my.xml: is there already, changed"));
  EXPECT_EQ(Slurp(folder_ / "my.xml"), changed) << "what a user has put in stays";
  EXPECT_EQ(Run("robot my.urdf --out my.urdf").status, 2);
  EXPECT_EQ(Run("robot my.urdf --set cruise_mpss=0.3").status, 2);
  EXPECT_EQ(Run("robot beluga --set cruise_mps=0.3").status, 2) << "an MJCF states it";
}

// What is left to be seen of a terminal's text: without colours, and of a line that was rewritten
// in place the last.
std::string Seen(std::string text) {
  for (const char* sequence : {"\033[1;36m", "\033[1m", "\033[0m"})
    for (std::size_t at; (at = text.find(sequence)) != std::string::npos;)
      text.erase(at, std::string_view(sequence).size());
  std::string seen;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    line.erase(line.find_last_not_of('\r') + 1);
    const std::string anew = "\r\033[K";
    const std::size_t last = line.rfind(anew);
    seen += (last == std::string::npos ? line : line.substr(last + anew.size())) + "\n";
  }
  return seen;
}

// A drive ends with a table that fits the window, and says the same in each.
TEST_F(Cli, RunEndsWithATableThatFitsTheWindow) {
  std::string text = Slurp(folder_ / "s.yaml");
  const std::string site = "  site: 1\n";
  text.insert(text.find(site) + site.size(), "  name: 階段のあるとても長い名前のホール\n");
  std::ofstream(folder_ / "s.yaml") << text;
  const auto words = [](const std::string& table) {
    std::string joined;
    for (const char c : table)
      if (std::string_view(" \n:").find(c) == std::string_view::npos) joined += c;
    return joined.substr(0, joined.find("simulatedin"));  // a wall time, which differs
  };
  std::string first;
  for (const auto& [columns, no_color] :
       {std::pair<int, const char*>(40, nullptr), {80, "1"}, {200, ""}}) {
    const std::string all =
        OnATerminal(folder_, {"run", "s.yaml", "--out", "o"}, columns, no_color);
    const bool coloured = all.find("\033[1;36m") != std::string::npos;
    EXPECT_EQ(coloured, no_color == nullptr || *no_color == '\0') << all;
    if (!coloured) {
      EXPECT_THAT(all, Not(HasSubstr("\033[1m")));
    }
    const std::string seen = Seen(all);
    const std::size_t begin = seen.find("beluga on ");
    ASSERT_NE(begin, std::string::npos) << seen;
    const std::string table = seen.substr(begin);
    std::istringstream lines(table);
    for (std::string line; std::getline(lines, line);)
      EXPECT_LE(DisplayWidth(line), columns) << line;
    const std::string gap = columns == 40 ? ": " : "             ";
    EXPECT_THAT(table, HasSubstr("\n  Verdict" + gap + "success\n"));
    EXPECT_THAT(table, HasSubstr("\n  Results" + gap + "o\n"));
    if (first.empty()) first = words(table);
    EXPECT_EQ(words(table), first);
  }
}

// The counts of "WHAT: N of M".
std::vector<int> Counts(const std::string& seen, const std::string& what) {
  std::vector<int> counts;
  for (std::size_t at = 0; (at = seen.find(what + ": ", at)) != std::string::npos;) {
    at += what.size() + 2;
    counts.push_back(std::atoi(seen.c_str() + at));
  }
  return counts;
}

TEST_F(Cli, ATerminalIsToldHowFarDrawingIs) {
  const auto run = [](const std::string& frames) -> std::vector<std::string> {
    return {"run",
            "s.yaml",
            "--video",
            "--out",
            "o",
            "--set",
            "video.max_frames=" + frames,
            "--set",
            "video.width=480",
            "--set",
            "video.height=270"};
  };
  const std::string seen = OnATerminal(folder_, run("40"));
  if (seen.find("video.mp4") == std::string::npos)
    GTEST_SKIP() << "nothing can be filmed: " << seen;
  const std::vector<int> frames = Counts(seen, "filming, frames");
  ASSERT_GE(frames.size(), 1u) << seen;
  EXPECT_TRUE(std::ranges::is_sorted(frames));
  EXPECT_THAT(seen, HasSubstr(" s to go"));

  std::vector<std::string> quiet = run("9");
  quiet.insert(quiet.begin(), "--quiet");
  EXPECT_EQ(OnATerminal(folder_, quiet), "");
}

}  // namespace
}  // namespace floorproof
