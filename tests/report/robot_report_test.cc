// SPDX-License-Identifier: Apache-2.0
#include "report/robot_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "report/robot_picture.h"

namespace floorproof {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

std::vector<std::string> RobotLines(const RobotCheck& check) {
  std::vector<std::string> lines;
  SayRobot(check, {.listener = [&](const std::string& line) { lines.push_back(line); }});
  return lines;
}

// All that its file and docs say of BELUGA.
TEST(RobotReport, SaysWhatBelugaIs) {
  const RobotCheck beluga = CheckRobot("beluga");
  const auto lines = RobotLines(beluga);
  for (const char* said :
       {"differential", "2 driven, radius 50 mm", "270 mm", "335 mm over the floor",
        "0.25 m/s cruise", "ahead left 48", "straight/way", "nothing is wrong with it"})
    EXPECT_THAT(lines, Contains(HasSubstr(said)));
  const auto json = RobotCheckJson(beluga);
  EXPECT_EQ(json["ok"], true);
  EXPECT_NEAR(json["clearance_m"].get<double>(), 0.025, 1e-6);
  EXPECT_EQ(json["carriers"].size(), 4u);
  EXPECT_EQ(json["support_edges"].size(), 4u);
  EXPECT_EQ(json["ten_seconds"].size(), beluga.drive.rows.size());
}

// One word on what it crosses: the one that planners go by.
TEST(RobotReport, SaysWhatPlannersTakeItToCross) {
  RobotCheck check;
  check.drive.rows.clear();
  check.spec.step_m = 0.010;
  check.spec.wheels.resize(1);
  const auto crosses = [&] {
    std::string text;
    for (const auto& [name, value] : RobotFigures(check)) {
      EXPECT_NE(name, "measured");
      if (name == "crosses") text = value;
    }
    return text;
  };
  EXPECT_EQ(crosses(), "steps of 10 mm, as its model says");
  check.spec.measured.by = "a test";
  check.spec.measured.frictions = {0.4, 0.8};
  check.spec.measured.limits = {{"threshold", {0.012, 0.014}}};
  EXPECT_EQ(crosses(),
            "threshold 14 mm, as measured on friction 0.8; steps of 10 mm, as its model "
            "says");
  check.spec.measured.limits.push_back({"step", {0.007, 0.008}});
  EXPECT_EQ(crosses(), "step 8 mm, threshold 14 mm, as measured on friction 0.8");
  DropLimits(check.spec.measured, "it was painted");
  EXPECT_EQ(crosses(), "steps of 10 mm, as its model says");
}

TEST(RobotReport, SaysWhatIsWrong) {
  RobotCheck check = CheckRobot("beluga");
  check.findings.push_back({Finding::Kind::kNote, "a note", "of no weight"});
  EXPECT_TRUE(check.ok());
  check.findings.push_back({Finding::Kind::kWrong, "it squeaks", "oil it"});
  EXPECT_THAT(RobotLines(check), Contains("wrong: it squeaks: oil it"));
  EXPECT_EQ(RobotCheckJson(check)["ok"], false);
  EXPECT_EQ(RobotCheckJson(check)["findings"].back()["mend"], "oil it");
}

TEST(RobotPicture, IsTheSameEachTimeAndShowsWhatIsWrong) {
  RobotCheck check = CheckRobot("beluga");
  const auto parts = PartsOf(ReadRobot(FindRobotFile("beluga", {})));
  const Image dut = DrawRobot(check, parts);
  EXPECT_EQ(DrawRobot(check, parts).data, dut.data);
  check.findings.push_back({Finding::Kind::kWrong, "it squeaks", "oil it"});
  EXPECT_NE(DrawRobot(check, parts).data, dut.data);
}

}  // namespace
}  // namespace floorproof
