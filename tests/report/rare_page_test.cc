// SPDX-License-Identifier: Apache-2.0
#include "report/rare_page.h"

#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "run/rare/rare_json.h"
#include "tests/own_folder.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class RarePageTest : public OwnFolderTest {
 protected:
  RarePageTest() {
    outcome_.name = "hall <script>";
    outcome_.mode = "stuck";
    outcome_.coordinates = {"site.floor.friction"};
    RareEstimate& e = outcome_.estimate;
    e.answer = RareAnswer::kEstimate;
    e.probability = 1e-5;
    e.cov = 0.1;
    e.effective_failures = 300;
    e.interval = IntervalOf(e, 0.95);
    e.lower_bound = 7e-6;
    e.upper_bound = 0.002;
    e.nominal_draws = 1500;
    e.fresh_draws = 2000;
    e.fresh_failures = 1000;
    e.trials = 9000;
    e.pilots.assign(5, {SubsetPilot::End::kFoundFailures, 5, 100, 2e-5});
    e.regions = {{.share = 1, .draws = 1000, .pilots = 5, .distance = 4.2, .searched = true}};
    EpisodeRow row;
    row.outcome = "failure";
    row.events = R"([{"kind":"","hazard":"<b>","t_s":1,"x_m":2,"y_m":3,"mode":"stuck"}])";
    outcome_.failures = {{0, {{"site.floor.friction", ConfigNode::Scalar("0.31")}}, row}};
  }
  void Save(const std::string& text) const { std::ofstream(folder_ / "rare.json") << text; }

  RareOutcome outcome_;
};

TEST_F(RarePageTest, AnUnfinishedSearchSaysHowToGoOn) {
  std::ofstream(folder_ / "trials.sqlite") << "";
  EXPECT_TRUE(HoldsRareSearch(folder_));
  try {
    MakeRarePage(folder_);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("--resume goes on"));
  }
}

TEST_F(RarePageTest, SaysWhatTheSearchSaid) {
  EXPECT_FALSE(HoldsRareSearch(folder_));
  Save(RareJson(outcome_).dump());
  EXPECT_TRUE(HoldsRareSearch(folder_));
  const RarePage dut = MakeRarePage(folder_);
  EXPECT_THAT(dut.verdict, HasSubstr("stuck: 1 in 100,000 drives"));
  EXPECT_THAT(dut.html,
              AllOf(HasSubstr("1 in 100,000"), HasSubstr("stuck at &lt;b&gt; after 1.0 s"),
                    HasSubstr("it counts the ways to fail that it found"),
                    HasSubstr("1,500 drives as they come, of which 0 failed"), HasSubstr("0.31"),
                    HasSubstr("299,572 drives")));
  EXPECT_THAT(dut.html, AllOf(Not(HasSubstr("<script")), Not(HasSubstr("<b>")),
                              Not(HasSubstr("http://")), Not(HasSubstr("https://"))));
}

TEST_F(RarePageTest, SaysThatThereIsNoEstimate) {
  outcome_.estimate.answer = RareAnswer::kNoEstimate;
  outcome_.estimate.why = "one draw makes 60 % of it";
  Save(RareJson(outcome_).dump());
  const RarePage dut = MakeRarePage(folder_);
  EXPECT_THAT(dut.verdict, HasSubstr("no estimate from 9,000 drives: one draw makes 60 % of it"));
  EXPECT_THAT(dut.html, Not(HasSubstr(">Estimate<")));
}

TEST_F(RarePageTest, WhatIsNoAnswerIsRefused) {
  for (const char* text : {"", "[]", "{}", R"({"rare": 2})", R"({"rare": 1})",
                           R"({"rare": 1, "mode": 3, "answer": "estimate"})"}) {
    Save(text);
    EXPECT_THROW(MakeRarePage(folder_), InputError) << text;
  }
  Save(R"({"rare": 1, "probability": )" + std::string(1'000'000, '[') +
       std::string(1'000'000, ']') + "}");
  EXPECT_THROW(MakeRarePage(folder_), InputError);
}

}  // namespace
}  // namespace floorproof
