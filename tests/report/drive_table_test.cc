// SPDX-License-Identifier: Apache-2.0
// The table that a drive ends with.
#include "report/drive_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/text_width.h"
#include "run/scenario/scenario.h"

namespace floorproof {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

class DriveTableTest : public ::testing::Test {
 protected:
  DriveTableTest() {
    s_.world.robot.spec.name = "BELUGA";
    s_.world.site.map.name = "hall";
    s_.spec.planner_name = "spiral";
    Hazard& plank = s_.world.site.map.hazards.emplace_back();
    plank.id = "plank";
    plank.type = "step";
    plank.height_m = 0.04;
    record_.outcome = Outcome::kSuccess;
    record_.metrics.coverage = 1;
    record_.metrics.duration_s = 1200;
    record_.metrics.path_length_m = 1250.4;
    record_.metrics.energy_j = 1.16e6;
    record_.metrics.max_cross_track_m = 0.0187;
    record_.margins = {{"veer_off", FailureMode::kVeerOff, 0.3, 0.6},
                       {"stuck", FailureMode::kStuck, 0.1, 0.2},
                       {"roll_over", FailureMode::kRollOver, kPi / 9, 0.5},
                       {"bounce_back", FailureMode::kBounceBack, 0.025, 1}};
  }
  void AddStuck() {
    Event e;
    e.mode = FailureMode::kStuck;
    e.t_s = 198.76;
    e.x_m = 5.579;
    e.y_m = 2.674;
    e.hazard = "plank";
    e.effect = "E3";
    e.evidence = {{"commanded_s", 10}, {"still_s", 7.6}};
    record_.events.push_back(e);
    record_.outcome = Outcome::kFailure;
  }
  std::vector<std::string> Lines(int width) const {
    return DriveTable(s_, plan_, record_, 4).Lines(width, false);
  }
  std::string Text(int width) const {
    std::string text;
    for (const std::string& line : Lines(width)) text += line + "\n";
    return text;
  }

  Scenario s_;
  PlanResult plan_;
  EpisodeRecord record_;
};

TEST_F(DriveTableTest, SaysWhatCameOfIt) {
  EXPECT_THAT(
      Lines(200),
      ElementsAre(
          "BELUGA on hall, spiral",  //
          "  Verdict             success",
          "  Covered             100 % of the floor that the tool can reach",
          "  Drive               1,200 s, 1,250 m, 1,160 kJ; simulated in 4 s, 300 times as "
          "fast",
          "  Off the path        19 mm at most",
          "  Nearest to failing  stuck, 100 mm of 500 mm left; roll over, 50 % left; "
          "veer off, 300 mm of 500 mm left"));
}

TEST_F(DriveTableTest, AFailureIsSaidOnceWithItsEvidence) {
  AddStuck();
  const auto dut = Lines(200);
  EXPECT_EQ(dut[1],
            "  Verdict             failure, stuck at 198.8 s: stood still for 7.6 s before 'plank' "
            "(step, 40 mm), at x 5.58, y 2.67 m; effect E3");
  EXPECT_THAT(dut.back(), Not(HasSubstr("stuck"))) << "it is not near to it, it failed so";
  record_.message = "the battery cut off";
  EXPECT_THAT(Lines(300)[1], HasSubstr("effect E3: the battery cut off"));
}

TEST_F(DriveTableTest, SeveralFailuresHaveTheNumbersOfTheMaps) {
  for (int i = 0; i < 12; ++i) AddStuck();
  record_.interventions.resize(11);
  const auto dut = Lines(200);
  EXPECT_EQ(dut[1], "  Verdict             failure, the robot failed 12 times, helped 11 times");
  EXPECT_THAT(dut[2], HasSubstr("  Failure 1           stuck at 198.8 s: "));
  EXPECT_THAT(dut[10], HasSubstr("  Failure 9           stuck at 198.8 s: "));
  EXPECT_EQ(dut[11], "  Further failures    3, see result.json");
}

TEST_F(DriveTableTest, ALimitThatWasPassedTooShortlyIsSaidToBe) {
  record_.margins = {{"veer_off", FailureMode::kVeerOff, 0, 0}};
  EXPECT_EQ(Lines(200).back(),
            "  Nearest to failing  veer off, at or beyond its limit, though not for long enough to "
            "count");
  record_.margins.clear();
  EXPECT_THAT(Text(200), Not(HasSubstr("Nearest")));
}

TEST_F(DriveTableTest, OverCellsThereIsNoTimeAndNoFailure) {
  s_.spec.episode.drive = "cells";
  record_.metrics.revisited = 0.123;
  record_.steps = 1251;
  EXPECT_THAT(Lines(200),
              ElementsAre("BELUGA on hall, spiral",  //
                          "  Verdict             success",
                          "  Covered             100 % of the cells, 12.3 % twice or more",
                          "  Drive               1,250 moves, 1,250 m; in 4 s"));
}

TEST_F(DriveTableTest, FitsAnyWindow) {
  AddStuck();
  s_.world.site.map.name = "階段のあるとても長い名前のホール";
  for (const int width : {40, 80, 200})
    for (const std::string& line : Lines(width)) EXPECT_LE(DisplayWidth(line), width) << line;
  EXPECT_THAT(Text(40),
              HasSubstr("\n  Covered: 100 % of the floor that the\n    tool can reach\n"));
  EXPECT_THAT(Text(80), HasSubstr("\n                      'plank' (step, 40 mm), at x 5.58"));
}

TEST_F(DriveTableTest, ANameMovesNoCursor) {
  s_.world.site.map.name = "hall\033[2J\nVerdict success";
  EXPECT_EQ(Lines(80)[0], "BELUGA on hall?[2J Verdict success, spiral");
}

}  // namespace
}  // namespace floorproof
