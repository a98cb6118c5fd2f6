// SPDX-License-Identifier: Apache-2.0
// The parts of a search for rare failures over a scenario's draws. Whole searches are slow tests.
#include "run/rare/rare_search.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "run/campaign/campaign_about.h"
#include "run/rare/rare_json.h"
#include "run/scenario/agents.h"
#include "run/scenario/scenario_file.h"
#include "tests/run/rare_scenario.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

class RareTest : public RareScenarioTest {
 protected:
  // The line with which a search of this scenario is refused.
  std::string Refusal(const std::vector<Override>& overrides, RareRequest request = {}) const {
    try {
      SearchRare(File(overrides), request, folder_ / "out");
    } catch (const InputError& e) {
      EXPECT_FALSE(fs::exists(folder_ / "out/trials.sqlite")) << "it was driven";
      return e.what();
    }
    return "it was not refused";
  }
};

TEST_F(RareTest, EachDistributionIsACoordinate) {
  const Scenario base = File().Read(std::nullopt);
  // What is drawn need not be a key of the scenario: only the draws are looked at.
  SaveScenario(
      "{a.x: {uniform: [2, 4]}, b: {normal: [1, 0.5]}, c: {lognormal: [3, 0.1]}, d: "
      "{choice: [p, q, r]}, e: {uniform: [7, 7]}}");
  const ScenarioFile file = File();
  const RareCoordinates dut(file, base);
  EXPECT_THAT(dut.keys(), ElementsAre("a.x", "b", "c", "d"));
  EXPECT_FALSE(dut.noisy());
  const auto at = [&](double u) {
    std::vector<std::string> values;
    for (const auto& [key, value] : dut.DrawnAt(Eigen::VectorXd::Constant(4, u)))
      values.push_back(value.scalar);
    return values;
  };
  EXPECT_THAT(at(0), ElementsAre("3", "1", "3", "q", "7"));
  const std::vector<std::string> far = at(5);
  EXPECT_NEAR(std::stod(far[0]), 4, 1e-5);
  EXPECT_NEAR(std::stod(far[1]), 3.5, 1e-6);
  EXPECT_NEAR(std::stod(far[2]), 3 * std::exp(0.5), 1e-5);
  EXPECT_EQ(far[3], "r");
  EXPECT_EQ(far[4], "7");
}

// Sensors draw by themselves: a trial has streams of its own, those of an episode.
TEST_F(RareTest, NoiseIsAnEpisode) {
  const ScenarioFile file = File({{"estimator", "mcl"}, {"sensors", "{lidar: {beams: 30}}"}});
  const RareCoordinates dut(file, file.Read(std::nullopt));
  EXPECT_TRUE(dut.noisy());
  const Drawn set = dut.AsSet({Eigen::VectorXd::Zero(dut.size()), 77});
  EXPECT_EQ(set.front().first, "episode");
  EXPECT_EQ(set.front().second.scalar, "77");
  EXPECT_EQ(file.ReadDrawn(77, dut.DrawnAt(Eigen::VectorXd::Zero(dut.size()))).spec.episode_id,
            77u);
}

// Without noise as written, but what is drawn brings it.
TEST_F(RareTest, NoiseMayBeDrawn) {
  for (const char* drawn : {"{estimator: {choice: [truth, mcl]}}",
                            "{sensors.imu.gyro_noise_radps: {uniform: [0, 0.1]}}"}) {
    SaveScenario(drawn);
    const ScenarioFile file = File();
    EXPECT_TRUE(RareCoordinates(file, file.Read(std::nullopt)).noisy()) << drawn;
  }
  SaveScenario("{site.floor.friction: {uniform: [0.5, 0.6]}}");
  const ScenarioFile file = File();
  EXPECT_FALSE(RareCoordinates(file, file.Read(std::nullopt)).noisy());
}

TEST_F(RareTest, WhatCannotBeSearchedIsRefusedBeforeAnythingIsDriven) {
  EXPECT_THAT(Refusal({{"randomise", "null"}}), HasSubstr("randomise: draws nothing"));
  EXPECT_THAT(Refusal({{"randomise", "null"}, {"estimator", "mcl"}}),
              HasSubstr("noise alone can only be counted"));
  EXPECT_THAT(Refusal({}, {.mode = "tumbled"}), HasSubstr("must be one of any_failure, veer_off"));
  EXPECT_THAT(Refusal({{"drive", "none"}}), HasSubstr("nothing that is not driven fails"));
  EXPECT_THAT(Refusal({}, {.settings = {.target_cov = 0.02, .max_trials = 5'000}}),
              HasSubstr("--max-n: 5000: --target-cov 0.02 takes 5,500 drives or more"));
  EXPECT_THAT(Refusal({{"gate", "{mode: rare, metric: stuck, max_rate: 0.001}"}}),
              HasSubstr("must be what --mode asks for, any_failure"));
  std::string many = "{";
  for (int i = 0; i < 41; ++i)
    many += "site.hazards." + std::to_string(i) + ".friction: {uniform: [0.5, 0.6]}, ";
  std::string hazards = "[";
  for (int i = 0; i < 41; ++i)
    hazards += "{type: wet, polygon_m: [[2.6, 0.6], [2.7, 0.6], [2.7, 0.7]]}, ";
  SaveScenario(many + "}", hazards + "]");
  EXPECT_THAT(Refusal({}), HasSubstr("draws more than 40 keys"));
}

TEST_F(RareTest, ACampaignDoesNotJudgeAGateThatIsNotItsOwn) {
  try {
    CampaignGate::Read(ParseYaml("{mode: rare, max_rate: 0.001}", "s.yaml"), 1000, true);
    FAIL() << "judged";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("is judged by floorproof rare"));
  }
}

TEST_F(RareTest, AModeThatNoDetectorMeasuresIsRefused) {
  std::vector<NamedDetector> detectors = MakeDetectors(File().Read(std::nullopt).spec);
  std::erase_if(detectors, [](const NamedDetector& d) { return d.name == "stuck"; });
  EXPECT_NO_THROW(RareScore("veer_off", detectors));
  EXPECT_THROW(RareScore("stuck", detectors), InputError);
}

// Ordinary rows: the mode's own margin leads, ties go by the way lost.
TEST_F(RareTest, TheScoreIsTheModesMargin) {
  const Scenario scenario = File().Read(std::nullopt);
  EpisodeRow row;
  row.outcome = "success";
  const auto set = [&](auto member, double value) { row.metrics[MetricIndex(member)] = value; };
  set(&Metrics::veer_off_margin, 0.7);
  set(&Metrics::stuck_margin, 1);
  set(&Metrics::roll_over_margin, 0.4);
  set(&Metrics::bounce_back_margin, 0.9);
  set(&Metrics::way_lost_m, 0.02);
  const auto of = [&](const char* mode) {
    return RareScore(mode, MakeDetectors(scenario.spec)).Of(row);
  };
  EXPECT_EQ(of("veer_off").score, 0.7);
  EXPECT_EQ(of("stuck").score, 1);
  EXPECT_EQ(of("any_failure").score, 0.4);
  const TrialResult little = of("stuck");
  set(&Metrics::way_lost_m, 0.05);
  EXPECT_TRUE(Nearness(of("stuck"), little) < 0) << "it lost more of its way";
  // An event is a failure whatever the margin says, and no margin is one.
  set(&Metrics::veer_off_margin, -0.1);
  EXPECT_FALSE(of("veer_off").failed) << "beyond for too short a time";
  row.outcome = "failure";
  row.events_of[static_cast<std::size_t>(FailureMode::kStuck)] = 1;
  EXPECT_TRUE(of("stuck").failed);
  EXPECT_TRUE(of("any_failure").failed);
  EXPECT_FALSE(of("veer_off").failed);
  row.outcome = "error";
  EXPECT_FALSE(of("stuck").failed);
  EXPECT_EQ(of("stuck").score, std::numeric_limits<double>::infinity());
}

// Margins of drives: as far from failing as the cross-track error leaves, and the way lost.
TEST_F(RareTest, MarginsStandInRows) {
  const ScenarioFile file = File();
  EpisodeMaker maker(file);
  const auto drive = [&](double error_m) {
    return maker.RunDrawn(RareTrials::TrialVariant(), 0, Believing(error_m));
  };
  const EpisodeRow near = drive(0.01), far = drive(0.04), off = drive(0.08);
  const auto margin = [](const EpisodeRow& row) { return *row.metric(&Metrics::veer_off_margin); };
  const auto error = [](const EpisodeRow& row) { return *row.metric(&Metrics::max_cross_track_m); };
  for (const EpisodeRow* row : {&near, &far})
    EXPECT_NEAR(margin(*row), 1 - error(*row) / kAllowed_m, 1e-6) << row->drawn;
  EXPECT_GT(margin(near), margin(far));
  EXPECT_LT(margin(off), 0);
  EXPECT_EQ(off.outcome, "failure");
  EXPECT_EQ(*near.metric(&Metrics::stuck_margin), 1);
  EXPECT_NEAR(*near.metric(&Metrics::way_lost_m), 0, 0.05);
}

class RareTrialsTest : public RareTest {
 protected:
  struct Drives {
    Drives(const ScenarioFile& scenario, const fs::path& db, int jobs)
        : file(scenario),
          base(file.Read(std::nullopt)),
          coordinates(file, base),
          score("veer_off", MakeDetectors(base.spec)),
          maker(file),
          store(fs::exists(db) ? Reopened(db) : CampaignStore::Create(db, DescribeCampaign(file))),
          trials(maker, coordinates, score, store, jobs,
                 [this](const RareProgress& p) { shown = p; }) {}
    static CampaignStore Reopened(const fs::path& db) {
      CampaignStore opened = CampaignStore::Open(db, true);
      return opened;
    }
    const ScenarioFile& file;
    Scenario base;
    RareCoordinates coordinates;
    RareScore score;
    EpisodeMaker maker;
    CampaignStore store;
    RareProgress shown;
    RareTrials trials;
  };
  static std::vector<Trial> Batch(double from) {
    std::vector<Trial> batch;
    for (int i = 0; i < 6; ++i) batch.push_back({Eigen::Vector2d(from + 0.5 * i, 0.1 * i), 0});
    return batch;
  }
};

TEST_F(RareTrialsTest, TrialsAreDrivenOnceWhateverTheWorkers) {
  const ScenarioFile file = File();
  std::vector<double> scores[2];
  for (const int jobs : {1, 2}) {
    Drives dut(file, folder_ / (std::to_string(jobs) + ".sqlite"), jobs);
    for (const double from : {0.0, 2.0})
      for (const TrialResult& result : dut.trials.Evaluate(Batch(from)))
        scores[jobs - 1].push_back(result.score + 100 * result.failed);
    EXPECT_THAT(dut.store.Episodes("trial"), SizeIs(12));
    EXPECT_EQ(dut.shown.driven, 12u);
  }
  EXPECT_EQ(scores[0], scores[1]);
  EXPECT_GT(std::ranges::max(scores[0]), 50) << "none failed";

  // Taken up again it drives nothing that is kept: no row is added twice, which would throw.
  {
    Drives again(file, folder_ / "1.sqlite", 2);
    std::vector<double> kept;
    for (const double from : {0.0, 2.0})
      for (const TrialResult& result : again.trials.Evaluate(Batch(from)))
        kept.push_back(result.score + 100 * result.failed);
    EXPECT_EQ(kept, scores[0]);
    EXPECT_EQ(again.shown.driven, 0u);
  }
  // Other draws than those that are kept under a number are not taken for them.
  Drives other(file, folder_ / "1.sqlite", 2);
  EXPECT_THROW(other.trials.Evaluate(Batch(0.25)), InternalError);
}

// An episode that draws make impossible is no failure, and is counted.
TEST_F(RareTrialsTest, ErrorsAreFarFromFailing) {
  SaveScenario("{start.y_m: {uniform: [-1, 1.6]}, site.floor.friction: {uniform: [1, 2]}}");
  const ScenarioFile file = File();
  Drives dut(file, folder_ / "t.sqlite", 1);
  const auto results = dut.trials.Evaluate(std::vector<Trial>{{Eigen::Vector2d(-1.5, 0), 0}});
  EXPECT_FALSE(results[0].failed);
  EXPECT_EQ(dut.trials.errors(), 1u);
  EXPECT_NE(dut.trials.first_error(), "");
}

// What the machine was to blame for is driven again, with all that came after it; what came before
// stays.
TEST_F(RareTrialsTest, ErrorsAreDrivenAgain) {
  const ScenarioFile file = File();
  const fs::path db = folder_ / "t.sqlite";
  Drives(file, db, 1).trials.Evaluate(Batch(2));
  CampaignStore store = CampaignStore::Open(db, true);
  store.DropFromFirstError("trial");
  EXPECT_THAT(store.Episodes("trial"), SizeIs(6)) << "there is none";
  std::vector<EpisodeRow> rows;
  store.ForEach("trial", [&](const EpisodeRow& row) { rows.push_back(row); });
  const fs::path broken = folder_ / "broken.sqlite";
  {
    CampaignStore other = CampaignStore::Create(broken, DescribeCampaign(file));
    rows[3].outcome = "error";
    rows[5].outcome = "error";
    other.Add(rows);
    other.DropFromFirstError("trial");
    EXPECT_THAT(other.Episodes("trial"), ElementsAre(0, 1, 2));
  }
  Drives dut(file, broken, 1);
  dut.trials.Evaluate(Batch(2));
  EXPECT_EQ(dut.shown.driven, 3u);
  EXPECT_EQ(dut.trials.errors(), 0u);
  const Trial last = Batch(2).back();
  EXPECT_EQ(dut.trials.RowOf(last).episode, 5u);
  EXPECT_EQ(dut.trials.RowOf(last).drawn, rows[5].drawn);
}

RareEstimate Estimated(double probability, double cov) {
  RareEstimate e;
  e.answer = RareAnswer::kEstimate;
  e.probability = probability;
  e.cov = cov;
  e.effective_failures = 400;
  e.freedom = 399;
  e.nominal_draws = 1500;
  e.upper_bound = 0.002;
  e.interval = IntervalOf(e, 0.95);
  return e;
}

TEST_F(RareTest, TheGateSaysWhatItsVerdictRestsOn) {
  const auto judge = [&](const RareEstimate& e, const std::string& limit) {
    return RareGate::Read(ParseYaml("{mode: rare, max_rate: " + limit + "}", "g"), "any_failure")
        ->Judge(e);
  };
  const RareVerdict passed = judge(Estimated(1e-5, 0.1), "0.0001");
  EXPECT_EQ(passed.verdict, GateVerdict::kPassed);
  EXPECT_TRUE(passed.rests_on_sampler);
  EXPECT_THAT(passed.text, HasSubstr("resting on the sampler"));
  EXPECT_EQ(judge(Estimated(1e-3, 0.1), "0.0001").verdict, GateVerdict::kFailed);
  EXPECT_EQ(judge(Estimated(1e-4, 0.1), "0.0001").verdict, GateVerdict::kUndecided);
  // A rate that the drives as they come show needs no sampler.
  const RareVerdict plain = judge(Estimated(1e-5, 0.1), "0.01");
  EXPECT_EQ(plain.verdict, GateVerdict::kPassed);
  EXPECT_FALSE(plain.rests_on_sampler);
  RareEstimate nothing;
  nothing.answer = RareAnswer::kNothingFound;
  nothing.nominal_draws = 7000;
  EXPECT_EQ(judge(nothing, "0.001").verdict, GateVerdict::kPassed);
  EXPECT_EQ(judge(nothing, "0.0001").verdict, GateVerdict::kUndecided);
  RareEstimate none;
  none.nominal_draws = 1000;
  none.lower_bound = 0.001;  // whatever the sampler did
  EXPECT_EQ(judge(none, "0.0001").verdict, GateVerdict::kFailed);
  none.lower_bound = 0;
  // Drives as they come that show less than the failures that were drawn show at least.
  RareEstimate contradiction = Estimated(2.2e-3, 0.03);
  contradiction.lower_bound = 2.1e-3;
  contradiction.nominal_draws = 2000;
  EXPECT_EQ(judge(contradiction, "0.002").verdict, GateVerdict::kUndecided);
  EXPECT_EQ(RareGate::Read(ParseYaml("{mode: rare, max_rate: 0.01}", "g"), "any_failure")
                ->Judge(Estimated(1e-5, 0.1), 1)
                .verdict,
            GateVerdict::kUndecided);
  EXPECT_EQ(judge(none, "0.0001").verdict, GateVerdict::kUndecided);
  EXPECT_FALSE(RareGate::Read(ParseYaml("{max_rate: 0.1}", "g"), "any_failure"));
}

TEST_F(RareTest, TheAnswerIsSaidInWords) {
  RareOutcome outcome;
  outcome.mode = "stuck";
  outcome.estimate = Estimated(1.25e-5, 0.08);
  outcome.estimate.reached_target = true;
  outcome.estimate.trials = 9000;
  outcome.estimate.lower_bound = 9e-6;
  outcome.estimate.regions = {{.share = 0.8, .draws = 300, .pilots = 5, .distance = 4.1}};
  EpisodeRow row;
  row.outcome = "failure";
  row.events = R"([{"kind":"","hazard":"sill","t_s":1,"x_m":2,"y_m":3,"mode":"stuck"}])";
  outcome.failures = {{0,
                       {{"episode", ConfigNode::Scalar("9")},
                        {"site.floor.friction", ConfigNode::Scalar("0.31")},
                        {"what", ParseYaml("{a: [1, 2], b: it's}", "t")}},
                       row}};
  const auto lines = RareLines(outcome, "out/my floor");
  const auto said = [&](const std::string& text) {
    EXPECT_THAT(lines, testing::Contains(HasSubstr(text)));
  };
  said("stuck: 1 in 80,000 drives (0.00125 %, 95 % interval 0.00107 % to 0.00146 %)");
  said("that rests on the sampler");
  said("at least 0.0009 %, and, by 1,500 drives as they come of which 0 failed, at most 0.2 %");
  said("takes 239,658 drives without a failure");
  said("stuck at sill with episode 9, site.floor.friction 0.31");
  said(
      "floorproof run 'out/my floor/scenario.resolved.yaml' --video --set episode=9 --set "
      "site.floor.friction=0.31 --set 'what={a: [1, 2], b: it'\\''s}'");
  const auto json = RareJson(outcome);
  EXPECT_EQ(json["answer"], "estimate");
  EXPECT_EQ(json["regions"][0]["likeliest"]["set"][1], "site.floor.friction=0.31");
  EXPECT_THAT(json["regions"][0]["likeliest"]["command"].get<std::string>(),
              testing::StartsWith("floorproof run scenario.resolved.yaml --video --set episode=9"));
  EXPECT_EQ(json["without_sampler"]["nominal_draws"], 1500);

  outcome.estimate.answer = RareAnswer::kNoEstimate;
  outcome.estimate.why = "one draw makes 40 % of it";
  outcome.estimate.pilots = {{SubsetPilot::End::kFoundFailures, 4, 30, 1e-5},
                             {SubsetPilot::End::kStalled, 9, 0, 0}};
  const auto none = RareLines(outcome, "o");
  EXPECT_THAT(none, testing::Contains(HasSubstr("no estimate: one draw makes 40 % of it")));
  EXPECT_THAT(none, testing::Contains(HasSubstr("its pilots said: 0.001 %, none")));
  EXPECT_TRUE(RareJson(outcome)["probability"].is_null());
}

}  // namespace
}  // namespace floorproof
