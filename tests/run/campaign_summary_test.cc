// SPDX-License-Identifier: Apache-2.0
// What rows amount to; summary.json says it, and is read back as it was.
#include "run/campaign/campaign_summary.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/file_output.h"
#include "run/campaign/campaign_junit.h"
#include "run/campaign/summary_json.h"
#include "stats/binomial.h"
#include "stats/poisson.h"
#include "tests/own_folder.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

// Driven 500 m in half an hour. 2 is stuck twice in one square, 3 without an event, 4 no episode
// that counts, 5 an error.
EpisodeRow Row(std::uint64_t episode) {
  EpisodeRow row;
  row.variant = "v";
  row.episode = episode;
  row.outcome = "success";
  for (std::size_t i = 0; i < kMetrics.size(); ++i)
    row.metrics[i] = static_cast<double>(i + episode);
  row.metrics[MetricIndex(&Metrics::path_length_m)] = 500;
  row.metrics[MetricIndex(&Metrics::duration_s)] = 1800;
  row.metrics[MetricIndex(&Metrics::battery_left)].reset();
  if (episode == 2) {
    row.outcome = "failure";
    row.events_of[static_cast<std::size_t>(FailureMode::kStuck)] = 2;
    row.events = R"([{"mode":"stuck","kind":"held","t_s":1,"x_m":1.1,"y_m":0.6,"hazard":"sill"},)"
                 R"({"mode":"stuck","kind":"","t_s":9,"x_m":1.4,"y_m":0.9,"hazard":""}])";
  }
  if (episode == 3) row.outcome = "failure";
  if (episode >= 4) {
    row.outcome = episode == 4 ? "not_planned" : "error";
    row.message = "a wall";
    row.metrics.fill(std::nullopt);
  }
  return row;
}

class CampaignSummaryTest : public OwnFolderTest {
 protected:
  CampaignSummary Summary(const std::string& mode) const {
    fs::remove(folder_ / "campaign.sqlite");
    CampaignStore store = CampaignStore::Create(
        folder_ / "campaign.sqlite", {"id", "seed: 1\n", R"({"floorproof":"1","mujoco":"2"})"});
    std::vector<EpisodeRow> rows;
    for (std::uint64_t episode = 0; episode < 6; ++episode) rows.push_back(Row(episode));
    store.Add(rows);
    store.SetAsked(8);
    std::vector<GateState> gates;
    if (!mode.empty()) {
      GateParams params;
      params.mode = mode;
      gates.emplace_back(params,
                         GateSettings{mode == "fixed" ? GateMode::kFixed : GateMode::kSequential,
                                      params.max_rate, params.confidence, 1, 400});
      for (const bool failed : {false, false, true, true})
        gates.front().Add(failed, failed ? "failed" : "passed");
    }
    Variant variant;
    variant.name = "v";
    Variant none;
    none.name = "no rows";
    return Summarise(store, {variant, none}, gates, "6 of 8 stand");
  }
  fs::path Write(const std::string& text) const {
    WriteFileWhole(folder_ / "summary.json", text);
    return folder_ / "summary.json";
  }
};

TEST_F(CampaignSummaryTest, AddsUpWhatCounts) {
  const CampaignSummary dut = Summary("");
  EXPECT_EQ(dut.campaign, "id");
  EXPECT_EQ(dut.episodes, 8u);
  EXPECT_THAT(dut.versions, ElementsAre(std::pair<std::string, std::string>("floorproof", "1"),
                                        std::pair<std::string, std::string>("mujoco", "2")));
  ASSERT_EQ(dut.variants.size(), 2u);
  const VariantSummary& v = dut.variants[0];
  EXPECT_EQ(v.n, 4);
  EXPECT_EQ(v.errors, 1);
  EXPECT_EQ(v.not_planned, 1);
  EXPECT_EQ(v.first_error, "episode 5: a wall");
  EXPECT_EQ(v.success, 2);
  EXPECT_EQ(v.failure, 2);
  ASSERT_EQ(v.failures.size(), 6u);
  EXPECT_EQ(v.failures[0].name, "any_failure");
  EXPECT_EQ(v.failures[0].k, 2);
  EXPECT_EQ(v.failures[0].n, 4);
  EXPECT_EQ(v.failures[0].rate, 0.5);
  EXPECT_EQ(v.failures[0].upper, ClopperPearson(2, 4, 0.95).upper);
  EXPECT_EQ(v.failures[5].name, "not_success");
  EXPECT_EQ(v.failures[5].k, 3) << "without a plan too";
  EXPECT_EQ(v.failures[5].n, 5);
  EXPECT_EQ(v.per_km[0].k, 3) << "two events, and too little covered";
  EXPECT_EQ(v.per_km[0].exposure, 2);
  EXPECT_EQ(v.per_km[0].lower, GarwoodInterval(3, 2, 0.95).lower);
  EXPECT_EQ(v.per_1000_h[0].exposure, 0.002);
  ASSERT_EQ(v.kinds.size(), 3u);
  EXPECT_EQ(v.kinds[0].name, "coverage");
  EXPECT_EQ(v.kinds[1].name, "stuck");
  EXPECT_EQ(v.kinds[2].name, "stuck/held");
  ASSERT_EQ(v.hazards.size(), 1u);
  EXPECT_EQ(v.hazards[0].name, "sill");
  ASSERT_EQ(v.places.size(), 1u) << "an episode counts once in a square";
  EXPECT_EQ(v.places[0].rate.k, 1);
  EXPECT_EQ(v.places[0].p_W, Vec2(1.25, 0.75));
  EXPECT_THAT(v.first_episode, ElementsAre(std::pair<std::string, std::uint64_t>("stuck", 2)));
  ASSERT_EQ(v.metrics.size(), kMetrics.size());
  for (std::size_t i = 0; i < kMetrics.size(); ++i) {
    EXPECT_EQ(v.metrics[i].name, kMetrics[i].name);
    EXPECT_EQ(v.metrics[i].spread.has_value(), i != MetricIndex(&Metrics::battery_left));
  }
  EXPECT_EQ(v.metrics[0].spread->mean, 1.5);
  EXPECT_EQ(v.metrics[0].spread->max, 3);
  EXPECT_TRUE(std::isnan(dut.variants[1].failures[0].rate));
  EXPECT_TRUE(std::isinf(dut.variants[1].per_km[0].upper));
}

TEST_F(CampaignSummaryTest, IsReadBackAsItWasWritten) {
  for (const char* mode : {"", "fixed", "sequential"}) {
    const CampaignSummary dut = Summary(mode);
    const std::string text = SummaryJson(dut).dump(2) + "\n";
    const CampaignSummary back = ReadSummary(Write(text));
    EXPECT_EQ(SummaryJson(back).dump(2) + "\n", text);
    EXPECT_EQ(JunitXml(back, false, "s"), JunitXml(dut, false, "s"));
    EXPECT_EQ(back.gate.has_value(), *mode != '\0');
  }
}

TEST_F(CampaignSummaryTest, AMetricsFormerNameIsStillRead) {
  const std::string text = SummaryJson(Summary("")).dump();
  std::string former = text;
  const std::string name = "mean_estimate_position_std_m";
  for (auto at = former.find(name); at != std::string::npos; at = former.find(name, at))
    former.replace(at, name.size(), "mean_estimate_spread_m");
  ASSERT_NE(former, text);
  EXPECT_EQ(SummaryJson(ReadSummary(Write(former))).dump(), text);
}

TEST_F(CampaignSummaryTest, TheGateIsSaidInWords) {
  const CampaignSummary dut = Summary("fixed");
  ASSERT_TRUE(dut.gate);
  EXPECT_EQ(Criterion(*dut.gate), "any_failure < 5 % at 95 %");
  EXPECT_THAT(GateText(*dut.gate, dut.gate->variants[0]),
              HasSubstr("undecided (any_failure < 5 % at 95 %): 2 of the first 4"));
  GateSummary passed = *dut.gate;
  passed.variants[0].aborted = 3;
  EXPECT_THAT(GateText(passed, passed.variants[0]),
              HasSubstr("; 3 more robots stopped by themselves, which not_success counts and "
                        "any_failure does not"));
  passed.metric = "not_success";
  EXPECT_THAT(GateText(passed, passed.variants[0]), testing::Not(HasSubstr("stopped")));
  const std::string junit = JunitXml(dut, false, "s");
  EXPECT_THAT(junit, HasSubstr("name=\"any_failure &lt; 5 % at 95 %\""));
  EXPECT_THAT(junit, HasSubstr("<error message=\"1 episode ended in error\">episode 5: a wall<"));
}

// Of each number that can be one.
TEST_F(CampaignSummaryTest, OneEpisodeIsSaidInTheSingular) {
  CampaignSummary dut = Summary("fixed");
  VariantSummary& variant = dut.variants[0];
  variant.n = 1;
  for (const int errors : {0, 1, 2}) {
    variant.errors = errors;
    const std::string junit = JunitXml(dut, false, "s");
    EXPECT_THAT(junit, HasSubstr("1 episode: ")) << errors;
    EXPECT_EQ(junit.find("; 1 error, ") != std::string::npos, errors == 1);
    EXPECT_EQ(junit.find(" 2 errors, ") != std::string::npos, errors == 2);
  }
}

// Each value in turn is of another kind, each key not there: one line that names the file.
TEST_F(CampaignSummaryTest, WhatIsDamagedIsRefused) {
  const Json whole = SummaryJson(Summary("sequential")), flat = whole.flatten();
  const auto why = [&](const std::string& text) -> std::string {
    try {
      ReadSummary(Write(text));
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_EQ(why(whole.dump()), "");
  for (const char* text : {"", "{", "[]", "3"})
    EXPECT_THAT(why(text), HasSubstr("summary.json: is not a campaign's summary (a JSON object)"))
        << text;
  std::string many = "{\"0\": 0";  // the time for an object's keys grows with their square
  for (int i = 1; i <= 20'000; ++i) many += fmt::format(", \"{}\": 0", i);
  EXPECT_THAT(why(many + "}"), HasSubstr("more than 20000 keys"));
  for (const auto& [at, value] : flat.items()) {
    // What is always the same is not read.
    if (at.ends_with("/method") || at.ends_with("/confidence")) continue;
    Json other = whole;
    other[Json::json_pointer(at)] = {{"x", "y"}};
    const std::string line = why(other.dump());
    EXPECT_THAT(line, HasSubstr("summary.json: ")) << at;
    EXPECT_THAT(line, HasSubstr(at.substr(at.rfind('/') + 1))) << "names its key";
  }
  for (const auto& [key, value] : whole.items()) {
    Json other = whole;
    other.erase(key);
    EXPECT_THAT(why(other.dump()), HasSubstr("summary.json: " + key + ": is missing"));
  }
  fs::remove(folder_ / "summary.json");
  try {
    ReadSummary(folder_ / "summary.json");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("no such file: not the folder of a finished `campaign`"));
  }
}

}  // namespace
}  // namespace floorproof
