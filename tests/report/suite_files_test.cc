// SPDX-License-Identifier: Apache-2.0
#include "report/suite_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "report/suite_page.h"
#include "tests/report/html_page.h"

namespace floorproof {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

MethodResult Step(double size_mm) {
  MethodResult result;
  result.method = "step";
  result.sizes = SizeLadder{"height", "mm", {}};
  result.n = 2;
  result.reliability_lower = 0.5;
  result.size = size_mm;
  result.runs = {{.run = 1,
                  .size = size_mm,
                  .verdict = {true},
                  .duration_s = 8,
                  .friction = 0.7,
                  .mass_kg = 9.5},
                 {.run = 0, .size = size_mm + 1, .verdict = {false, "stuck at <step>"}}};
  result.shown = 1;
  result.simulated_s = 8;
  return result;
}

MethodResult Obstacle(int failures) {
  MethodResult result;
  result.method = "obstacle";
  result.n = 2;
  result.failures = failures;
  return result;
}

MethodResult Lost() {
  MethodResult result;
  result.method = "lost";
  result.not_applicable = "the model has no lidar";
  return result;
}

SuiteReport TwoRobots() {
  SuiteReport report;
  report.options = {.reliability = 0.5, .confidence = 0.75};
  report.required = {{"step", 11}};
  report.robots = {{.robot = "a", .label = "a", .methods = {}, .filmed = {}},
                   {.robot = "b<b>", .label = "b<b>", .methods = {}, .filmed = {}}};
  report.robots[0].methods = {Step(12), Obstacle(1), Lost()};
  report.robots[1].methods = {Step(10), Obstacle(0)};
  report.asked = 3;
  return report;
}

int Count(const std::string& text, const std::string& part) {
  int n = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at) ++n;
  return n;
}

TEST(SuiteFiles, ARowAMethodAndARowARun) {
  const std::string csv = SuiteCsv(TwoRobots());
  EXPECT_EQ(Count(csv, "\n"), 6);
  EXPECT_THAT(csv, HasSubstr("a,step,limit found,12,mm,0,13,,,,2,0,0.5,\n"));
  EXPECT_THAT(csv, HasSubstr("a,obstacle,failed,,,0,,,,,2,1,0,1 of 2 failed\n"));
  EXPECT_THAT(csv, HasSubstr("a,lost,not applicable,"));
  EXPECT_THAT(
      csv, HasSubstr("b<b>,step,limit found,10,mm,0,11,,,,2,0,0.5,\"10 mm, 11 mm is required\"\n"));
  const std::string runs = SuiteRunsCsv(TwoRobots());
  EXPECT_EQ(Count(runs, "\n"), 5);
  EXPECT_THAT(runs, HasSubstr("a,step,12,mm,1,0.7,9.5,")) << "as it was driven";
}

// Who counts its failures reads what is there; markup within does not end a tag.
TEST(SuiteFiles, JunitHasACaseAMethod) {
  const std::string dut = SuiteJunit(TwoRobots());
  EXPECT_THAT(dut, HasSubstr("<testsuites tests=\"5\" failures=\"2\" errors=\"0\" skipped=\"1\">"));
  EXPECT_EQ(Count(dut, "<testcase "), 5);
  EXPECT_EQ(Count(dut, "<failure "), 2);
  EXPECT_EQ(Count(dut, "<skipped "), 1);
  EXPECT_EQ(Count(dut, "<testcase classname=\"suite.a\" name=\"step\" time=\"8.000\">"), 1);
  EXPECT_EQ(WhyUnbalanced(dut.substr(dut.find('\n') + 1)), "");
}

TEST(SuiteFiles, JsonSaysWhatWasAskedAndFound) {
  const auto json = SuiteJson(TwoRobots());
  EXPECT_EQ(json["n"], 2);
  EXPECT_EQ(json["required"]["step"], 11);
  EXPECT_EQ(json["robots"][0]["methods"][0]["size"], 12);
  EXPECT_FALSE(json["robots"][0]["methods"][0].contains("missed"));
  EXPECT_EQ(json["robots"][0]["whole"], true);
  EXPECT_EQ(json["robots"][1]["whole"], false);
  EXPECT_EQ(json["robots"][1]["methods"][0]["missed"], "10 mm, 11 mm is required");
}

// What is set for every run was not drawn, and whoever reads the files learns of it.
TEST(SuiteFiles, SayWhatWasSet) {
  SuiteReport dut = TwoRobots();
  EXPECT_TRUE(SuiteJson(dut)["set"].empty());
  dut.options.overrides = {{"robot.mass_kg", "30"}};
  EXPECT_EQ(SuiteJson(dut)["set"]["robot.mass_kg"], "30");
  EXPECT_THAT(SuitePage(dut, "."), HasSubstr("Set for every run instead: robot.mass_kg = 30."));
}

// Wherever the size is read, it is read that a harder one was taken back.
TEST(SuiteFiles, SayWhatWasTakenBack) {
  SuiteReport dut = TwoRobots();
  dut.robots[0].methods[0].withdrawn = 80;
  const char* said = "lso fails at an easier size: 13 mm; so 80 mm, which all runs pass, does not";
  EXPECT_EQ(Count(SuitePage(dut, "."), said), 2) << "in the table and in words";
  EXPECT_THAT(SuiteJunit(dut), HasSubstr(said));
  const auto json = SuiteJson(dut)["robots"][0]["methods"][0];
  EXPECT_THAT(std::string(json["text"]), HasSubstr(said));
  EXPECT_EQ(json["withdrawn"], 80);
  EXPECT_EQ(json["fails_at"], 13);
  EXPECT_THAT(SuiteCsv(dut), HasSubstr("a,step,limit found,12,mm,0,13,80,"));
}

TEST(SuitePage, ShowsRobotsSideBySideAndLoadsNothing) {
  const std::string dut = SuitePage(TwoRobots(), ".");
  EXPECT_EQ(WhyUnbalanced(dut), "");
  for (const char* said :
       {"a and b&lt;b&gt;", "12 mm", "10 mm", "width:100.0%", "width:83.3%", "not applicable",
        "not done", "At 13 mm run 0 failed: stuck at &lt;step&gt;.", "Not every method",
        "1 of 3 are not done"})
    EXPECT_THAT(dut, HasSubstr(said));
  for (const char* no : {"<script", "http:", "https:", "<b>", "<video"})
    EXPECT_THAT(dut, Not(HasSubstr(no)));
}

}  // namespace
}  // namespace floorproof
