// SPDX-License-Identifier: Apache-2.0
// Episodes that are equal are one: no gate is judged on them, and rates say so.
#include "run/campaign/repetition.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "run/campaign/campaign_junit.h"
#include "run/campaign/campaign_merge.h"
#include "run/campaign/summary_json.h"
#include "run/scenario/chance.h"
#include "run/scenario/scenario_file.h"
#include "stats/binomial.h"
#include "tests/run/scenario_text.h"
#include "tests/slurp.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr const char* kGate = "gate: {metric: not_success, max_rate: 0.5}\n";
// A plan's floor is not told its friction: it changes nothing without physics.
constexpr const char* kNoEffect = "randomise: {site.floor.friction: {uniform: [0.6, 1.0]}}\n";

class RepetitionTest : public ScenarioTest {
 protected:
  RepetitionTest() { Save("plan.csv", "x_m,y_m\n1.5,2.5\n3.0,2.5\n"); }
  ScenarioFile File(const std::string& more) const {
    return ScenarioFile(Save("s.yaml", RoomScenario("", more)));
  }
  std::string Folder(const char* name) const { return (folder_ / name).string(); }
  std::string WhyRefused(const std::string& more, std::uint64_t episodes = 10) const {
    try {
      DriveCampaign(File("drive: none\n" + more), {.episodes = episodes}, Folder("o"));
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }
  bool CanDiffer(const std::string& more) const {
    const ScenarioFile file = File(more);
    return EpisodesCanDiffer(file, file.Read(std::nullopt));
  }
};

TEST_F(RepetitionTest, AGateOnOneEpisodeIsRefusedBeforeAnythingIsDriven) {
  for (const char* draws :
       {"", "randomise: {}\n", "randomise: {start.x_m: {uniform: [1.5, 1.5]}}\n",
        "randomise: {start.x_m: {normal: [1.5, 0]}}\n",
        "randomise: {start.x_m: {choice: [1.5, 1.5]}}\n"}) {
    EXPECT_THAT(WhyRefused(std::string(kGate) + draws),
                AllOf(HasSubstr("s.yaml:"), HasSubstr("gate: nothing differs"),
                      HasSubstr("one, repeated"), HasSubstr("randomise: {")))
        << draws;
    EXPECT_FALSE(fs::exists(folder_ / "o")) << draws;
  }
  EXPECT_EQ(WhyRefused(std::string(kGate) + "randomise: {start.x_m: {uniform: [1.4, 1.6]}}\n"), "");
}

TEST_F(RepetitionTest, WithoutChanceMoreEpisodesAreNotAskedFor) {
  // Ten clean episodes cannot show less than 0.1 %.
  const std::string gate = "gate: {metric: not_success, max_rate: 0.001}\n";
  EXPECT_THAT(WhyRefused(gate), AllOf(HasSubstr("nothing differs"), Not(HasSubstr("-n"))));
  EXPECT_THAT(WhyRefused(gate + "randomise: {start.x_m: {uniform: [1.4, 1.6]}}\n"),
              AllOf(HasSubstr("-n"), Not(HasSubstr("nothing differs"))));
}

TEST_F(RepetitionTest, ChanceIsFoundWhereverItIs) {
  EXPECT_FALSE(CanDiffer(""));
  EXPECT_FALSE(
      CanDiffer("estimator: {name: odometry, start_error_x_m: 0.1}\n"
                "sensors: {encoders: {noise: 0}, imu: {gyro_noise_radps: 0, "
                "gyro_bias_radps: 0, accel_noise_mps2: 0, accel_bias_mps2: 0}}\n"));
  EXPECT_TRUE(CanDiffer("sensors: {imu: {}}\n"));
  EXPECT_TRUE(CanDiffer("sensors: {encoders: {noise: 0.01}}\n"));
  EXPECT_FALSE(CanDiffer("sensors: {imu: {}}\ndrive: none\n")) << "nothing senses";
  EXPECT_FALSE(CanDiffer("sensors: {bumper: {}, cliff: {}}\n"));
  EXPECT_TRUE(CanDiffer(kNoEffect)) << "that it has no effect is known only afterwards";
}

TEST_F(RepetitionTest, ARandomSiteIsChanceAFixedOneIsNot) {
  const auto differ = [&](const char* generate) {
    const ScenarioFile file(
        Save("g.yaml", std::string("scenario: 1\nrobot: beluga\nsite: {site: 1, generate: {") +
                           generate + "}}\n"));
    return EpisodesCanDiffer(file, file.Read(std::nullopt));
  };
  EXPECT_TRUE(differ("cells: [12, 12]"));
  EXPECT_FALSE(differ("cells: [12, 12], seed: 3"));
}

TEST_F(RepetitionTest, WithoutAGateItIsSaid) {
  class Listener : public CampaignObserver {
   public:
    void OnWarning(const std::string& line) override { warnings.push_back(line); }
    std::vector<std::string> warnings;
  };
  Listener one, many;
  DriveCampaign(File("drive: none\n"), {.episodes = 3}, Folder("a"), &one);
  EXPECT_THAT(one.warnings, ElementsAre(HasSubstr("one, repeated")));
  DriveCampaign(File("drive: none\n"), {.episodes = 1}, Folder("b"), &many);
  EXPECT_THAT(many.warnings, IsEmpty()) << "one episode is one";
}

TEST_F(RepetitionTest, DrawsWithoutEffectAreFoundInWhatCameOut) {
  const ScenarioFile file = File(std::string("drive: none\n") + kGate + kNoEffect);
  const CampaignOutcome dut = DriveCampaign(file, {.episodes = 10}, Folder("o"));
  const VariantSummary& v = dut.summary.variants.at(0);
  EXPECT_TRUE(v.repeated);
  EXPECT_EQ(v.n, 10);
  const FailureRate& not_success = v.failures.back();
  EXPECT_EQ(not_success.n, 1) << "one episode";
  EXPECT_EQ(not_success.upper, ClopperPearson(0, 1, 0.95).upper);
  EXPECT_EQ(dut.summary.gate->verdict, GateVerdict::kUndecided);
  EXPECT_THAT(dut.summary.gate->variants.at(0).report.text, HasSubstr("one episode, repeated"));
  EXPECT_THAT(Slurp(folder_ / "o/junit.xml"),
              AllOf(HasSubstr("one episode, repeated"), HasSubstr("skipped=\"1\"")));
  const CampaignSummary read = ReadSummary(folder_ / "o/summary.json");
  EXPECT_TRUE(read.variants.at(0).repeated);
  EXPECT_EQ(SummaryJson(read).dump(), SummaryJson(dut.summary).dump());
}

TEST_F(RepetitionTest, ShardsAndResumedCampaignsOfOneEpisodeAreNotJudgedEither) {
  const ScenarioFile file = File(std::string("drive: none\n") + kGate + kNoEffect);
  DriveCampaign(file, {.episodes = 10, .shard = EpisodeRange{0, 5}}, Folder("a"));
  DriveCampaign(file, {.episodes = 10, .shard = EpisodeRange{5, 10}}, Folder("b"));
  const MergeOutcome merged = MergeCampaigns({Folder("a"), Folder("b")}, folder_ / "all");
  EXPECT_EQ(merged.summary.gate->verdict, GateVerdict::kUndecided);
  EXPECT_TRUE(merged.summary.variants.at(0).repeated);
  const CampaignOutcome resumed =
      DriveCampaign(file, {.episodes = 10, .resume = true}, Folder("a"));
  EXPECT_EQ(resumed.summary.gate->verdict, GateVerdict::kUndecided);
  EXPECT_TRUE(resumed.summary.variants.at(0).repeated);
}

// A gate that is told equal episodes, then one that differs.
class HeldGateTest : public ::testing::TestWithParam<const char*> {
 protected:
  GateState Start() const {
    GateParams params;
    params.mode = GetParam();
    return {params, Settings()};
  }
  GateSettings Settings() const {
    return {std::string(GetParam()) == "fixed" ? GateMode::kFixed : GateMode::kSequential, 0.05,
            0.95, 1, 200};
  }
};

TEST_P(HeldGateTest, NoNumberOfEqualEpisodesIsEnough) {
  for (const bool failed : {false, true}) {
    GateState dut = Start();
    for (int i = 0; i < 199; ++i) dut.Add(failed, "the same");
    EXPECT_FALSE(dut.decided());
    dut.Add(failed, "the same");
    EXPECT_TRUE(dut.decided()) << "no more are judged";
    dut.End();
    EXPECT_EQ(dut.verdict(), GateVerdict::kUndecided);
    EXPECT_EQ(dut.Report().n, 1);
  }
}

TEST_P(HeldGateTest, OneThatDiffersMakesAllOfThemCount) {
  GateState dut = Start();
  Gate plain(Settings());
  for (int i = 0; i < 199; ++i) dut.Add(false, "the same"), plain.Add(false);
  dut.Add(false, "another"), plain.Add(false);
  dut.End(), plain.End();
  EXPECT_EQ(dut.verdict(), GateVerdict::kPassed);
  EXPECT_EQ(dut.Report().n, plain.Report().n);
  EXPECT_EQ(dut.Report().text, plain.Report().text);
}

INSTANTIATE_TEST_SUITE_P(Modes, HeldGateTest, ::testing::Values("fixed", "sequential"));

TEST(ResultHash, IsOfWhatCameOutAndNotOfWhatWasDrawn) {
  EpisodeRow row;
  row.outcome = "success";
  row.metrics.fill(1.0);
  const std::string dut = row.ResultHash();
  EpisodeRow other = row;
  other.drawn = "{\"start.x_m\": 2}";
  other.episode = 7;
  other.wall_s = 3;
  EXPECT_EQ(other.ResultHash(), dut);
  other.metrics[0] = std::nextafter(1.0, 2.0);
  EXPECT_NE(other.ResultHash(), dut) << "to the last bit";
  other = row;
  other.plan = "{\"length_m\": 1}";
  EXPECT_NE(other.ResultHash(), dut);
}

}  // namespace
}  // namespace floorproof
