// SPDX-License-Identifier: Apache-2.0
// The page of a measurement, of meetings that were drawn with known rates.
#include "report/measure_page.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "measure/risk_files.h"
#include "run/campaign/summary_json.h"
#include "run/scenario/scenario_parts.h"
#include "tests/measure/planted_rates.h"
#include "tests/own_folder.h"
#include "tests/report/html_page.h"
#include "tests/slurp.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kVariant = "meeting=step over";

// Steps hold the robot from about 10 mm on.
ModeNumbers Rates(const Encounter& e) {
  return {0, 3 * Step((e.size[0].second - 0.01) / 0.0005), 0, 0};
}

class MeasurePageTest : public OwnFolderTest {
 protected:
  // `count` drives, each of one meeting; rates are fitted to them.
  void Measure(int count, const PlantedRates& rates = Rates) {
    CampaignStore store =
        CampaignStore::Create(folder_ / "campaign.sqlite", {"0123456789abcdef", "", "{}"});
    Stream random(3, 0, "measure_page_test");
    std::vector<EpisodeRow> rows;
    for (Encounter& e : DrawEncounters(count, rates, DrawStep, random)) {
      EpisodeRow row;
      row.variant = kVariant;
      row.episode = rows.size();
      row.outcome = e.outcome == Encounter::Outcome::kFailed ? "failure" : "success";
      e.hazard = "<script>alert(1)</script>";
      row.encounters = {e};
      rows.push_back(row);
    }
    store.Add(rows);
    const auto model = FitRiskModel(store, ReadRobot(FindRobotFile("beluga", {})), {}, folder_);
    ASSERT_TRUE(model);
    WriteRiskModel(*model, folder_);
    CampaignSummary summary{.campaign = "0123456789abcdef"};
    summary.versions = {{"floorproof", "<i>"}};
    std::ofstream(folder_ / "summary.json") << SummaryJson(summary).dump();
    std::ofstream(folder_ / "scenario.resolved.yaml") << "scenario: 1  # <b>\n";
  }
  std::string WhyRefused() const {
    try {
      WriteMeasureReport(folder_, "here");
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }
};

TEST_F(MeasurePageTest, SaysWhatFailsHowLargeAHazardMayBeAndHowToSeeIt) {
  Measure(2000);
  ASSERT_TRUE(HoldsMeasurement(folder_));
  const WrittenReport dut = WriteMeasureReport(folder_, "my folder");
  EXPECT_THAT(dut.verdict, AllOf(HasSubstr("beluga in 2,000 meetings with 1 type of hazard"),
                                 HasSubstr("over them, most often at: step")));
  const std::string page = Slurp(dut.page);
  EXPECT_EQ(page.size(), dut.bytes);
  EXPECT_EQ(WhyUnbalanced(page), "");
  // The height decides; up to where the planted rates are small it is safe.
  EXPECT_THAT(page, HasSubstr("<figcaption>step height, mm"));
  EXPECT_THAT(page, Not(HasSubstr("<figcaption>friction")));  // decides nothing here
  EXPECT_THAT(page, testing::ContainsRegex("<td>up to (9\\.[0-9]*|10\\.[0-2][0-9]*) mm \\("));
  EXPECT_THAT(page, HasSubstr("floorproof replay &#39;my folder&#39; --episode "));
  EXPECT_THAT(page, HasSubstr("--variant &#39;meeting=step over&#39; --video"));
  EXPECT_THAT(page, HasSubstr("held against no whole plan"));
  EXPECT_THAT(page, HasSubstr("experts 80 %"));  // of rolling over at a level change
  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(page, AllOf(HasSubstr("&lt;i&gt;"), HasSubstr("&lt;b&gt;")));
}

TEST_F(MeasurePageTest, WhereNothingFailsItSaysSo) {
  Measure(300, [](const Encounter&) { return ModeNumbers{}; });
  const WrittenReport dut = WriteMeasureReport(folder_, "here");
  EXPECT_THAT(dut.verdict, HasSubstr("over them nothing failed"));
  EXPECT_THAT(Slurp(dut.page), AllOf(HasSubstr("<p>Nothing failed.</p>"),
                                     HasSubstr("over the whole range drawn (0 of 300 failed)")));
}

TEST_F(MeasurePageTest, WhatPlansCameToIsTold) {
  Measure(500);
  RiskModel model = *FitRiskModel(CampaignStore::Open(folder_ / "campaign.sqlite", false),
                                  ReadRobot(FindRobotFile("beluga", {})), {}, folder_);
  model.carry_over = {
      .intercept = 0, .slope = 2, .plans = 20, .drives = 40, .failed = 7, .expected = 9.25};
  WriteRiskModel(model, folder_);
  const WrittenReport dut = WriteMeasureReport(folder_, "here");
  EXPECT_THAT(dut.verdict, HasSubstr("Of 40 drives over whole plans its rates had 9 fail; 7 did."));
  EXPECT_THAT(Slurp(dut.page), HasSubstr("20 plans over small floors, 40 drives"));
}

// Files of two measurements.
TEST_F(MeasurePageTest, FilesThatDoNotGoTogetherAreRefused) {
  Measure(500);
  const std::string summary = Slurp(folder_ / "summary.json"),
                    tables = Slurp(folder_ / "fmea_measured.yaml");
  std::ofstream(folder_ / "summary.json")
      << SummaryJson(CampaignSummary{.campaign = "fedcba9876543210"}).dump();
  EXPECT_THAT(WhyRefused(), HasSubstr("is another campaign than campaign.sqlite's"));
  std::ofstream(folder_ / "summary.json") << summary;
  std::string other = tables;
  other.replace(other.find("robot: \"beluga\""), 15, "robot: \"rover\"");
  std::ofstream(folder_ / "fmea_measured.yaml") << other;
  EXPECT_THAT(WhyRefused(), HasSubstr("is another robot than risk_model.json's, beluga"));
}

// A folder that was gone on with, whose rates are of fewer meetings.
TEST_F(MeasurePageTest, RatesOfOtherMeetingsAreRefused) {
  Measure(500);
  EpisodeRow row;
  row.variant = kVariant;
  row.episode = 500;
  row.outcome = "success";
  Stream random(4, 0, "measure_page_test");
  row.encounters = {DrawStep(random)};
  CampaignStore::Open(folder_ / "campaign.sqlite", true).Add(std::vector{row});
  EXPECT_THAT(WhyRefused(), AllOf(HasSubstr("risk_model.json: encounters = 500"),
                                  HasSubstr("is not of the 501 encounters")));
  EXPECT_FALSE(fs::exists(folder_ / "report.html"));
}

TEST_F(MeasurePageTest, DamagedTablesAreRefused) {
  Measure(500);
  const std::string whole = Slurp(folder_ / "fmea_measured.yaml");
  for (const auto& [from, to] : {std::pair("experts: 0.8", "experts: 8"),
                                 std::pair("  C3:", "  C5:"), std::pair("F2: {", "F2: [")}) {
    std::string text = whole;
    ASSERT_NE(text.find(from), text.npos) << from;
    text.replace(text.find(from), std::string(from).size(), to);
    std::ofstream(folder_ / "fmea_measured.yaml") << text;
    EXPECT_THAT(WhyRefused(), HasSubstr("fmea_measured.yaml")) << from;
  }
  std::ofstream(folder_ / "fmea_measured.yaml") << "fmea_measured: 1\n";
  EXPECT_THAT(WhyRefused(), HasSubstr("is missing: not a file of floorproof measure"));
}

TEST_F(MeasurePageTest, IsOfMeasurementsAlone) {
  EXPECT_FALSE(HoldsMeasurement(folder_));
  std::ofstream(folder_ / "risk_model.json") << "{}";  // as in a measurement's plans/
  EXPECT_FALSE(HoldsMeasurement(folder_));
  std::ofstream(folder_ / "fmea_measured.yaml") << "";  // kept there by somebody
  EXPECT_FALSE(HoldsMeasurement(folder_));
}

}  // namespace
}  // namespace floorproof
