// SPDX-License-Identifier: Apache-2.0
// Campaigns driven and merged by a call, without the command line: what comes back, what is left.
#include "run/campaign/drive_campaign.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <set>

#include "env/scene/measured_block.h"
#include "run/campaign/campaign_merge.h"
#include "run/campaign/episode_maker.h"
#include "run/campaign/summary_json.h"
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
using ::testing::IsEmpty;

std::string SummaryText(const CampaignOutcome& outcome) {
  return SummaryJson(outcome.summary).dump(2) + "\n";
}

class Listener : public CampaignObserver {
 public:
  void OnWarning(const std::string& line) override { warnings.push_back(line); }
  void OnProgress(const CampaignProgress& progress) override { done = progress.done; }
  std::vector<std::string> warnings;
  std::uint64_t done = 0;
};

// A room whose plan is drawn, judged and driven nowhere.
class DriveCampaignTest : public ScenarioTest {
 protected:
  DriveCampaignTest() { Save("plan.csv", "x_m,y_m\n1.5,2.5\n3.0,2.5\n"); }

  ScenarioFile File(const std::string& more = "") const {
    return ScenarioFile(Save("s.yaml", RoomScenario("", "drive: none\n" + more)));
  }
  std::string Folder(const char* name) const { return (folder_ / name).string(); }
  void Shard(const ScenarioFile& file, std::uint64_t n, EpisodeRange range, const char* out) const {
    DriveCampaign(file, {.episodes = n, .shard = range}, Folder(out));
  }
};

constexpr const char* kFixedGate =
    "gate: {metric: not_success, max_rate: 0.5}\nrandomise: {start.x_m: {uniform: [1.4, 1.6]}}\n";

std::string WhyRefused(const std::function<void()>& call) {
  try {
    call();
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST_F(DriveCampaignTest, GivesTheSummaryThatItWrites) {
  Listener listener;
  const CampaignOutcome dut = DriveCampaign(File("matrix: {start.yaw_deg: [0, 10]}\n"),
                                            {.episodes = 3, .jobs = 2}, Folder("o"), &listener);
  EXPECT_EQ(dut.run.end, CampaignEnd::kComplete);
  EXPECT_EQ(dut.variants.size(), 2u);
  EXPECT_EQ(dut.summary.variants.at(1).success, 3);
  EXPECT_EQ(listener.done, 6u);
  EXPECT_EQ(Slurp(folder_ / "o/summary.json"), SummaryText(dut));
  for (const char* file : {"scenario.resolved.yaml", "episodes.csv", "junit.xml"})
    EXPECT_TRUE(fs::exists(folder_ / "o" / file)) << file;
  EXPECT_THAT(dut.store.Episodes("yaw_deg=10"), ElementsAre(0u, 1u, 2u));
}

TEST_F(DriveCampaignTest, DrawsThatCannotBeDrivenAreSaidBefore) {
  const auto warnings = [&](const std::string& range, const char* out) {
    Listener listener;
    DriveCampaign(File("randomise: {start.x_m: {uniform: " + range + "}}\n"), {.episodes = 40},
                  Folder(out), &listener);
    return listener.warnings;
  };
  EXPECT_THAT(warnings("[0.5, 1.6]", "some"),
              ElementsAre(AllOf(HasSubstr("of the first "), HasSubstr("cannot be driven"),
                                HasSubstr("overlaps a wall"))));
  EXPECT_THAT(warnings("[1.4, 1.6]", "none"), IsEmpty());
}

TEST_F(DriveCampaignTest, RequestsThatMakeNoSenseAreRefusedBeforeThereIsAFolder) {
  const auto why = [&](const CampaignRequest& request) {
    return WhyRefused([&] { DriveCampaign(File(), request, Folder("o")); });
  };
  EXPECT_EQ(why({.episodes = 0}), "-n: 0: must be in [1, 100000000]");
  EXPECT_EQ(why({.episodes = 100000001}), "-n: 100000001: must be in [1, 100000000]");
  EXPECT_EQ(why({.episodes = 3, .jobs = 0}), "--jobs: 0: must be in [1, 1024]");
  EXPECT_EQ(why({.episodes = 9, .shard = EpisodeRange{5, 3}}), "--episodes: 5:3: holds no episode");
  EXPECT_EQ(why({.episodes = 9, .shard = EpisodeRange{5, 10}}),
            "--episodes: 5:10: must lie within -n");
  EXPECT_FALSE(fs::exists(folder_ / "o"));
}

TEST_F(DriveCampaignTest, HandsWarningsToTheObserver) {
  fs::create_directories(folder_ / "far");
  fs::rename(folder_ / "plan.csv", folder_ / "far/plan.csv");
  std::string text = RoomScenario("", "drive: none\n");
  text.replace(text.find("plan.csv"), 8, "../far/plan.csv");
  fs::create_directories(folder_ / "near");
  Listener listener;
  DriveCampaign(ScenarioFile(Save("near/s.yaml", text), {}, Trust::kFull), {.episodes = 1},
                Folder("o"), &listener);
  EXPECT_THAT(listener.warnings, ElementsAre(HasSubstr("reads outside the scenario's folder")));
}

// Overwrites the plan once the campaign has been read.
class Meddler : public CampaignObserver {
 public:
  explicit Meddler(std::function<void()> meddle) : meddle_(std::move(meddle)) {}
  void OnWarning(const std::string&) override { meddle_(); }

 private:
  std::function<void()> meddle_;
};

TEST_F(DriveCampaignTest, AllEpisodesAreOfOneInput) {
  // A hazard off the map: a warning, which the meddler waits for.
  const std::string text = RoomScenario(
      "{type: step, polygon_m: [[50,50],[51,50],[51,51]], height_m: 0.1}", "drive: none\n");
  const auto rows = [&](const char* out) {
    std::vector<std::string> plans;
    CampaignStore::Open(folder_ / out / "campaign.sqlite", false)
        .ForEach("default", [&](const EpisodeRow& row) { plans.push_back(row.plan); });
    return plans;
  };
  DriveCampaign(ScenarioFile(Save("s.yaml", text)), {.episodes = 4}, Folder("quiet"));
  Meddler meddler([&] { Save("plan.csv", "x_m,y_m\n1.5,2.5\n6.0,2.5\n"); });
  DriveCampaign(ScenarioFile(folder_ / "s.yaml"), {.episodes = 4, .jobs = 2}, Folder("o"),
                &meddler);
  ASSERT_THAT(Slurp(folder_ / "plan.csv"), HasSubstr("6.0")) << "the meddler was there";
  EXPECT_EQ(rows("o"), rows("quiet"));
  EXPECT_EQ(rows("o").size(), 4u);
}

TEST_F(DriveCampaignTest, AFixedGateIsNotLookedAtTwice) {
  const ScenarioFile file = File(kFixedGate);
  const std::string judged = SummaryText(DriveCampaign(file, {.episodes = 6}, Folder("o")));
  EXPECT_THAT(judged, HasSubstr("\"verdict\": \"passed\""));
  EXPECT_THAT(
      WhyRefused([&] { DriveCampaign(file, {.episodes = 12, .resume = true}, Folder("o")); }),
      HasSubstr("-n: 12: the fixed gate was judged at 6 episodes"));
  EXPECT_EQ(CampaignStore::Open(folder_ / "o/campaign.sqlite", false).asked(), 6u);
  EXPECT_EQ(Slurp(folder_ / "o/summary.json"), judged);
}

TEST_F(DriveCampaignTest, WhatIsRefusedLeavesNoFolder) {
  EXPECT_THAT(WhyRefused([&] { DriveCampaign(File(kFixedGate), {.episodes = 2}, Folder("o")); }),
              HasSubstr("gate"));
  EXPECT_FALSE(fs::exists(folder_ / "o"));
}

TEST_F(DriveCampaignTest, ShardsMergeIntoTheWhole) {
  const ScenarioFile file = File(kFixedGate);
  Shard(file, 6, {0, 4}, "a");
  Shard(file, 6, {3, 6}, "b");
  const MergeOutcome dut = MergeCampaigns({Folder("b"), Folder("a")}, folder_ / "joined");
  EXPECT_EQ(dut.summary.gate->verdict, GateVerdict::kPassed);
  EXPECT_THAT(dut.gaps, IsEmpty());
  EXPECT_EQ(dut.paths_note, "");
  EXPECT_EQ(SummaryText(dut), SummaryText(DriveCampaign(file, {.episodes = 6}, Folder("whole"))));
}

TEST_F(DriveCampaignTest, MergeOfNoShardsIsRefused) {
  EXPECT_EQ(WhyRefused([&] { MergeCampaigns({}, folder_ / "joined"); }),
            "shards: there are none to merge");
  EXPECT_FALSE(fs::exists(folder_ / "joined"));
}

TEST_F(DriveCampaignTest, MergeNamesWhatNoShardHolds) {
  const ScenarioFile file = File(kFixedGate);
  Shard(file, 9, {0, 3}, "a");
  Shard(file, 9, {5, 6}, "b");
  fs::remove(folder_ / "plan.csv");  // as on a machine that has only the shards
  const MergeOutcome dut = MergeCampaigns({Folder("a"), Folder("b")}, folder_ / "joined");
  EXPECT_EQ(dut.run.end, CampaignEnd::kMissing);
  ASSERT_EQ(dut.gaps.size(), 1u);
  EXPECT_EQ(dut.gaps[0].variant, "default");
  std::vector<std::pair<std::uint64_t, std::uint64_t>> missing;
  for (const auto& [begin, end] : dut.gaps[0].missing) missing.emplace_back(begin, end);
  EXPECT_THAT(missing, ElementsAre(std::pair(3u, 5u), std::pair(6u, 9u)));
  EXPECT_EQ(dut.summary.variants.at(0).n, 3) << "the prefix alone counts";
  EXPECT_EQ(dut.summary.gate->verdict, GateVerdict::kUndecided);
  EXPECT_EQ(dut.paths_note, "") << "the shards' copies of what is gone are enough";
  fs::rename(folder_ / "joined", folder_ / "moved");
  EXPECT_NO_THROW(ScenarioFile(folder_ / "moved/scenario.resolved.yaml").Read());
  fs::remove_all(folder_ / "a/inputs");  // as of a version that kept none
  EXPECT_THAT(MergeCampaigns({Folder("a"), Folder("b")}, folder_ / "again").paths_note,
              AllOf(HasSubstr("its paths hold from " + Folder("a")),
                    HasSubstr("lies outside the scenario's folder")));
}

// A robot whose limits were measured: on a slippery floor it keeps off a step that it crosses on
// another. What an episode plans does not hang on which came before it in the same worker.
TEST_F(DriveCampaignTest, PlansByMeasuredLimitsHangOnTheirOwnEpisodeAlone) {
  const fs::path robot = Save("mine.xml", Slurp(SourceFile("models/beluga.xml")));
  const std::string limits =
      "<text name=\"measured_by\" data=\"a test\"/>\n<text name=\"measured_model\" data=\"" +
      ModelHash(std::vector<fs::path>{robot}, {}) +
      "\"/>\n<numeric name=\"measured_frictions\" data=\"0.4 0.8\"/>\n"
      "<numeric name=\"measured_speeds_mps\" data=\"0.2\"/>\n"
      "<numeric name=\"measured_step_forward_mm\" data=\"5 20\"/>\n";
  Save("mine.xml", WithMeasured(Slurp(robot), limits, robot));
  const ScenarioFile file(
      Save("s.yaml",
           "scenario: 1\nsite:\n  site: 1\n  name: hall\n  grid:\n    cell_m: 0.5\n"
           "    rows: |\n      ........\n      ........\n      ........\n"
           "      ........\n  hazards:\n    - {type: step, id: s, height_m: 0.008, "
           "polygon_m: [[2, 0], [4, 0], [4, 1], [2, 1]]}\n"
           "start: {x_m: 0.6, y_m: 1.0}\nrobot: mine.xml\nplan: boustrophedon\n"
           "drive: none\n"
           "randomise: {site.floor.friction: {choice: [0.5, 0.9]}, "
           "battery.voltage_v: {choice: [12, 11.5]}}\n"));
  EpisodeMaker one(file);
  std::set<std::string> plans;
  for (std::uint64_t episode = 0; episode < 12; ++episode) {
    EpisodeMaker fresh(file);
    const EpisodeRow alone = fresh.Run({}, episode);
    EXPECT_EQ(one.Run({}, episode).plan, alone.plan) << alone.drawn << alone.message;
    plans.insert(alone.plan);
  }
  EXPECT_EQ(plans.size(), 2u) << "over the step, and around it";
}

}  // namespace
}  // namespace floorproof
