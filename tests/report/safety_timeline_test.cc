// SPDX-License-Identifier: Apache-2.0
#include "report/safety_timeline.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "run/scenario/scenario.h"
#include "run/scenario/written_safety.h"

namespace floorproof {
namespace {

class SafetyTimelineTest : public ::testing::Test {
 protected:
  SafetyTimelineTest() {
    scenario_.spec.safety.emplace();
    scenario_.spec.safety->mission.name = "m";
    scenario_.spec.safety->mission.nodes.emplace_back().name = "m";
    record_.outcome = Outcome::kSuccess;
    record_.metrics.duration_s = 100;
    record_.speed_shares = {{0, 1}, {20, 0}, {30, 0.5}};
    record_.safety = {
        {20, "t.s.wheels", 48, SafetyLevel::kSerious, DecisionState::kReconfiguring, ""},
        {20, "m", 48, SafetyLevel::kSerious, DecisionState::kFaultMode, ""},
        {30, "m", 0, SafetyLevel::kHigh, DecisionState::kNormal, ""}};
    record_.alarms = {{20, "wheel_speed", "left", 28}, {40, "wheel_speed", "right", {}}};
  }
  void Break(const FaultTiming& timing) {
    scenario_.world.faults.push_back({"weak_motor", "loose", nullptr, timing});
  }
  TimelineRow Row(const std::string& name) const {
    const Timeline dut = SafetyTimeline(scenario_, record_);
    const auto row = std::ranges::find(dut.rows, name, &TimelineRow::name);
    EXPECT_NE(row, dut.rows.end()) << name;
    return row == dut.rows.end() ? TimelineRow{} : *row;
  }
  static std::string Text(const TimelineRow& row) {
    std::string text;
    for (const TimelineSpan& span : row.spans)
      text += std::to_string(std::lround(span.from_s)) + "-" +
              std::to_string(std::lround(span.to_s)) + " " + span.text + "; ";
    return text;
  }
  Scenario scenario_;
  EpisodeRecord record_;
};

TEST_F(SafetyTimelineTest, ShowsWhatWasDecidedAndDone) {
  EXPECT_EQ(Text(Row("state machine")), "0-20 normal; 20-30 fault mode; 30-100 normal; ");
  EXPECT_EQ(Text(Row("safety level")), "0-20 high; 20-30 serious; 30-100 high; ");
  EXPECT_EQ(Text(Row("speed")), "0-20 full speed; 20-30 stands; 30-100 50 %; ");
  EXPECT_EQ(Text(Row("alarm: wheel speed")), "20-28 left; 40-100 right; ");
}

TEST_F(SafetyTimelineTest, ShowsWhatWasBrokenWheneverItWas) {
  Break({.onset_s = 10, .duration_s = 50, .period_s = 20, .duty = 0.25});
  EXPECT_EQ(Text(Row("broken: loose")), "10-15 weak motor; 30-35 weak motor; 50-55 weak motor; ");
  scenario_.world.faults.clear();
  Break({.onset_s = 10, .duration_s = {}, .period_s = {}});
  EXPECT_EQ(Text(Row("broken: loose")), "10-100 weak motor; ");
  scenario_.world.faults.clear();
  Break({.onset_s = 1000, .duration_s = {}, .period_s = {}});
  EXPECT_EQ(Text(Row("broken: loose")), "");
  scenario_.world.faults.clear();
  Break({.onset_s = 0, .duration_s = {}, .period_s = 0.001, .duty = 0.5});
  EXPECT_LE(Row("broken: loose").spans.size(), 2000u);
}

TEST_F(SafetyTimelineTest, ShowsTheSumWhereSkillsBesideEachOtherFail) {
  for (SafetyRow& row : record_.safety) row.sum = row.safety_state;
  EXPECT_TRUE(SafetyTimeline(scenario_, record_).curve->behind.empty());
  record_.safety[1].sum = 130;
  const TimelineCurve dut = *SafetyTimeline(scenario_, record_).curve;
  using Steps = std::vector<std::pair<double, double>>;
  EXPECT_EQ(dut.steps, (Steps{{0, 0}, {20, 48}, {30, 0}}));
  EXPECT_EQ(dut.behind, (Steps{{0, 0}, {20, 130}, {30, 0}}));
  EXPECT_EQ(dut.most, 130);
}

TEST_F(SafetyTimelineTest, OfASoundDriveIsQuiet) {
  record_.safety.clear();
  record_.alarms.clear();
  record_.speed_shares = {{0, 1}};
  const Timeline dut = SafetyTimeline(scenario_, record_);
  EXPECT_EQ(dut.rows.size(), 3u);
  EXPECT_EQ(Text(Row("state machine")), "0-100 normal; ");
}

}  // namespace
}  // namespace floorproof
