// SPDX-License-Identifier: Apache-2.0
// `floorproof campaign`: the same files on any number of workers and after any interruption, exit
// statuses, what --resume takes and refuses.
#include "run/campaign/campaign.h"

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "run/campaign/episode_maker.h"
#include "run/scenario/scenario_file.h"
#include "tests/apps/campaign_program.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::ordered_json;

// Half of the episodes fail, so that a few show it.
constexpr const char* kGate =
    "gate: {metric: not_success, max_rate: 0.1, mode: sequential, max_n: 200}\n";

class CampaignTest : public CampaignProgram {};

TEST_F(CampaignTest, AnyNumberOfWorkersGivesTheSameFiles) {
  Write("matrix: {start.yaw_deg: [0, 10]}\n");
  ASSERT_EQ(Campaign("-n 6 --jobs 1 --out a").status, 0);
  ASSERT_EQ(Campaign("-n 6 --jobs 2 --out b").status, 0);
  ASSERT_EQ(Campaign("-n 6 --jobs 5 --out c").status, 0);
  ExpectSameResults("a", "b");
  ExpectSameResults("a", "c");
  EXPECT_EQ(Count("a", "SELECT count(*) FROM episode"), 12);
  const Json summary = Json::parse(Slurp(folder_ / "a/summary.json"));
  const Json& variant = summary["variants"]["yaw_deg=0"];
  EXPECT_EQ(variant["n"], 6);
  EXPECT_EQ(variant["outcomes"]["success"].get<int>() + variant["outcomes"]["failure"].get<int>() +
                variant["outcomes"]["timeout"].get<int>(),
            6);
  // Some do and some do not, or the comparisons above would compare little.
  EXPECT_GT(variant["outcomes"]["success"], 0);
  EXPECT_GT(variant["outcomes"]["failure"], 0);
}

TEST_F(CampaignTest, AnotherSeedIsAnotherCampaign) {
  ASSERT_EQ(Campaign("-n 2 --seed 1 --out a").status, 0);
  ASSERT_EQ(Campaign("-n 2 --seed 2 --out b").status, 0);
  EXPECT_NE(Select("a", "SELECT drawn FROM episode"), Select("b", "SELECT drawn FROM episode"));
  const Ended other = Run("compare a b");
  EXPECT_EQ(other.status, 2);
  EXPECT_THAT(other.said, HasSubstr(" in a and "));
  EXPECT_THAT(other.said, Not(HasSubstr("{")));
  // Variants of one name, told apart by their folders.
  ASSERT_EQ(Campaign("-n 2 --seed 1 --set physics.timestep_s=0.002 --out c").status, 0);
  EXPECT_THAT(Run("compare a c").out, HasSubstr("a: a:default\nb: c:default\n"));
}

TEST_F(CampaignTest, RunIsEpisodeNought) {
  for (const char* seed : {"0", "5"}) {
    const std::string out = std::string("c") + seed, run = std::string("r") + seed;
    ASSERT_EQ(Campaign("-n 2 --seed " + std::string(seed) + " --out " + out).status, 0);
    EXPECT_LE(Run("run s.yaml --seed " + std::string(seed) + " --out " + run).status, 1);
    Json result = Json::parse(Slurp(folder_ / run / "result.json"));
    for (Json& event : result["events"]) event.erase("text");  // the failure in words, for readers
    const CampaignStore store =
        CampaignStore::Open(folder_ / out / "campaign.sqlite", /*write=*/false);
    bool seen = false;
    store.ForEach("default", [&](const EpisodeRow& row) {
      if (row.episode != 0) return;
      seen = true;
      EXPECT_EQ(result["outcome"], row.outcome);
      EXPECT_EQ(result["events"].dump(), row.events);
      for (std::size_t i = 0; i < kMetrics.size(); ++i) {
        const Json& value = result["metrics"][std::string(kMetrics[i].name)];
        EXPECT_EQ(value.is_null(), !row.metrics[i].has_value()) << kMetrics[i].name;
        if (row.metrics[i]) {
          EXPECT_EQ(value.get<double>(), *row.metrics[i]) << kMetrics[i].name;
        }
      }
    });
    EXPECT_TRUE(seen);
  }
}

// What is kept from one episode to the next does not show in it.
TEST_F(CampaignTest, AnEpisodeIsTheSameAloneAndAmongOthers) {
  Write("matrix: {plan.overlap: [0, 0.2]}\n");
  std::string text = Slurp(folder_ / "s.yaml");
  text.replace(text.find("plan: {file: p.csv}"), 19, "plan: {planner: boustrophedon}\ndrive: none");
  text.replace(text.find("known: false"), 12, "known: true");
  std::ofstream(folder_ / "s.yaml") << text;
  const ScenarioFile file(folder_ / "s.yaml");
  EpisodeMaker among(file);
  for (std::uint64_t episode = 0; episode < 3; ++episode)
    for (const Variant& variant : file.variants())
      EXPECT_EQ(ToLine(among.Run(variant, episode)),
                ToLine(EpisodeMaker(file).Run(variant, episode)));
}

TEST_F(CampaignTest, AKilledCampaignGoesOn) {
  ASSERT_EQ(Campaign("-n 16 --jobs 2 --out whole").status, 0);
  const std::string command = "campaign s.yaml --no-films -n 16 --jobs 2 --out killed --resume";
  int killed = 0;
  for (const int then_ms : {0, 150, 400}) {
    Program dut(command, folder_);
    dut.AWorker();
    usleep(static_cast<useconds_t>(1000 * then_ms));
    dut.Send(SIGKILL);
    killed += dut.Wait() == -SIGKILL;
  }
  EXPECT_GE(killed, 1);
  ASSERT_EQ(Run(command).status, 0);
  ExpectSameResults("whole", "killed");
}

TEST_F(CampaignTest, AKilledWorkersEpisodeIsDrivenAgain) {
  ASSERT_EQ(Campaign("-n 10 --jobs 2 --out whole").status, 0);
  Program dut("campaign s.yaml --no-films -n 10 --jobs 2 --out killed", folder_);
  kill(dut.AWorker(), SIGKILL);
  EXPECT_EQ(dut.Wait(), 0) << dut.Said();
  ExpectSameResults("whole", "killed");
}

// Rows beyond the decision are there for certain where a shard, which has no gate, drove them.
TEST_F(CampaignTest, RowsBeyondAnEarlyDecisionAreKeptOut) {
  Write(kGate);
  ASSERT_EQ(Campaign("-n 200 --jobs 1 --out one").status, 1);
  const long n = Count("one", "SELECT count(*) FROM episode");
  ASSERT_GT(n, 1);
  ASSERT_LT(n, 25) << "the gate decides early";
  EXPECT_EQ(Count("one", "SELECT max(episode) FROM episode"), n - 1);

  ASSERT_EQ(Campaign("-n 200 --jobs 3 --out three").status, 1);
  ExpectSameResults("one", "three");

  ASSERT_EQ(Campaign("-n 200 --episodes 2:25 --jobs 2 --out shard").status, 0);
  ASSERT_EQ(Campaign("-n 200 --jobs 1 --out shard --resume").status, 1);
  ExpectSameResults("one", "shard");
  EXPECT_EQ(Count("shard", "SELECT count(*) FROM extra"), 25 - n);
  EXPECT_EQ(Count("shard", "SELECT count(*) FROM timing"), 25);

  // Again: nothing is left to do.
  ASSERT_EQ(Campaign("-n 200 --jobs 1 --out shard --resume").status, 1);
  ExpectSameResults("one", "shard");
}

// One variant decides, the other cannot: what the first has too many is kept out all the same.
TEST_F(CampaignTest, EachVariantEndsAtItsOwnDecision) {
  // In the second the sill lies beside the way.
  Write(std::string(kGate) +
        "matrix:\n  setup:\n  - {label: as_is, start.yaw_deg: 0}\n"
        "  - {label: beside, site.hazards.sill.shift_x_m: 0.9}\n");
  ASSERT_EQ(Campaign("-n 100 --jobs 1 --out one").status, 1);
  ASSERT_EQ(Campaign("-n 100 --episodes 0:25 --jobs 2 --out two").status, 0);
  ASSERT_EQ(Campaign("-n 100 --jobs 2 --out two --resume").status, 1);
  ExpectSameResults("one", "two");
  EXPECT_LT(Count("one", "SELECT count(*) FROM episode WHERE variant = 'setup=as_is'"), 25);
  EXPECT_GT(Count("one", "SELECT count(*) FROM episode WHERE variant = 'setup=beside'"), 25);
  EXPECT_EQ(Count("one", "SELECT sum(stuck) FROM episode WHERE variant = 'setup=beside'"), 0);
}

TEST_F(CampaignTest, FailFastEndsAtTheFirstIdThatFails) {
  Write("gate: {metric: roll_over, max_rate: 0.1}\nmatrix: {start.yaw_deg: [0, 10]}\n");
  for (const char* jobs : {"1", "2", "5"}) {
    const std::string out = std::string("j") + jobs;
    ASSERT_EQ(Campaign("-n 200 --fail-fast --jobs " + std::string(jobs) + " --out " + out).status,
              1);
    ExpectSameResults("j1", out);
  }
  const std::string failing = "FROM episode WHERE veer_off + stuck + roll_over + bounce_back > 0";
  EXPECT_EQ(Count("j1", "SELECT min(episode) " + failing),
            Count("j1", "SELECT max(episode) FROM episode"));
  // Driven before without: the same is kept.
  ASSERT_EQ(Campaign("-n 200 --episodes 0:8 --jobs 2 --out more").status, 0);
  ASSERT_EQ(Campaign("-n 200 --fail-fast --jobs 2 --out more --resume").status, 1);
  ExpectSameResults("j1", "more");
  Write("");
  EXPECT_EQ(Campaign("-n 200 --fail-fast --jobs 2 --out no_gate").status, 1);
  EXPECT_THAT(Slurp(folder_ / "no_gate/junit.xml"), HasSubstr("failures=\"1\""));
}

TEST_F(CampaignTest, MoreOrFewerEpisodesMayFollow) {
  ASSERT_EQ(Campaign("-n 3 --out few").status, 0);
  ASSERT_EQ(Campaign("-n 6 --out many").status, 0);
  ASSERT_EQ(Campaign("-n 3 --out grown").status, 0);
  ASSERT_EQ(Campaign("-n 6 --out grown --resume").status, 0);
  ExpectSameResults("many", "grown");
  ASSERT_EQ(Campaign("-n 3 --out grown --resume").status, 0);
  ExpectSameResults("few", "grown");
  ASSERT_EQ(Campaign("-n 6 --out grown --resume").status, 0);
  ExpectSameResults("many", "grown");
}

TEST_F(CampaignTest, AnUsedFolderIsRefused) {
  ASSERT_EQ(Campaign("-n 1 --out o").status, 0);
  const std::string bytes = Slurp(folder_ / "o/campaign.sqlite");
  const std::string summary = Slurp(folder_ / "o/summary.json");
  const auto expect = [&](const Ended& dut, const char* why) {
    EXPECT_EQ(dut.status, 2);
    EXPECT_THAT(dut.said, HasSubstr(why));
    EXPECT_EQ(std::ranges::count(dut.said, '\n'), 1) << dut.said;
    EXPECT_TRUE(Slurp(folder_ / "o/campaign.sqlite") == bytes);
    EXPECT_EQ(Slurp(folder_ / "o/summary.json"), summary);
  };
  expect(Campaign("-n 1 --out o"), "holds a campaign: --resume goes on with it");
  expect(Campaign("-n 1 --out o --resume --set time_limit_s=9"),
         "holds another campaign: time_limit_s was 12, is 9");
  expect(Campaign("-n 1 --out o --resume --seed 4"), "seed was 0, is 4");
  std::ofstream(folder_ / "p.csv") << "x_m,y_m\n1.0,1.0\n1.7,1.0\n";
  expect(Campaign("-n 1 --out o --resume"), "files.p.csv was ");
}

TEST_F(CampaignTest, BadInputIsOneLineAndStatusTwo) {
  std::ofstream(folder_ / "file") << "";
  for (const auto& [arguments, why] : std::vector<std::pair<std::string, std::string>>{
           {"", "-n"},
           {"-n 0", "-n"},
           {"-n x", "-n"},
           {"-n 3 --episodes 1", "must be A:B"},
           {"-n 3 --episodes 1:2x", "must be A:B"},
           {"-n 3 --episodes 2:2", "holds no episode"},
           {"-n 3 --episodes 2:4", "must lie within -n"},
           {"-n 3 --episodes -1:2", "--episodes"},
           {"-n 3 --jobs 0", "--jobs"},
           {"-n 3 --time-limit 0", "--time-limit"},
           {"-n 3 --out file", "a file is in the way"},
           {"-n 3 --set gate.max_rate=2", "gate.max_rate = 2: must be"},
           {"-n 3 --set gate.max_rate=0.05",
            "-n = 3: must be >= 59: with fewer episodes no outcome passes at this max_rate and "
            "confidence; for rates without a verdict: --set gate=none"},
           {"-n 3 --set randomise.seed.uniform=[1,2]", "cannot differ between episodes"},
       }) {
    const Ended dut = Campaign(arguments);
    EXPECT_EQ(dut.status, 2) << arguments;
    EXPECT_THAT(dut.said, HasSubstr(why)) << arguments;
    EXPECT_FALSE(fs::exists(folder_ / "out")) << arguments;
  }
}

TEST_F(CampaignTest, ExitStatuses) {
  EXPECT_EQ(Campaign("-n 2 --out done").status, 0) << "failures without a gate are results";
  const Ended limited = Campaign("-n 100000 --time-limit 0.4 --out limited");
  EXPECT_EQ(limited.status, 0);
  EXPECT_THAT(limited.out, HasSubstr("the time limit is reached (--resume goes on)"));
  Write(kGate);
  EXPECT_EQ(Campaign("-n 200 --out failed").status, 1);
  EXPECT_EQ(Campaign("-n 200 --time-limit 0.01 --out undecided").status, 4);
  EXPECT_EQ(Campaign("-n 2 --out refused").status, 2);
  int outs = 0;
  for (const char* none : {"none", "{}", ""})
    EXPECT_EQ(
        Campaign("-n 2 --set gate=" + std::string(none) + " --out none" + std::to_string(++outs))
            .status,
        0)
        << none;
  Write("gate: none\n");
  const Ended without = Campaign("-n 2 --out without");
  EXPECT_EQ(without.status, 0);
  EXPECT_THAT(without.out, Not(HasSubstr("Gate")));
  Write("gate: {metric: roll_over, max_rate: 0.6, confidence: 0.9}\n");
  EXPECT_EQ(Campaign("-n 5 --out passed").status, 0);
  Write("", "  start.x_m: {uniform: [0.1, 0.7]}\n");
  EXPECT_EQ(Campaign("-n 5 --out broken").status, 3) << "a start in a wall";
  EXPECT_GT(Count("broken", "SELECT count(*) FROM episode WHERE outcome = 'error'"), 0);
  EXPECT_THAT(Select("broken", "SELECT message FROM episode"), HasSubstr("lies in a wall"));
  EXPECT_THAT(Select("broken", "SELECT drawn FROM episode"), HasSubstr("start.x_m"));
  EXPECT_THAT(Slurp(folder_ / "broken/junit.xml"), HasSubstr("lies in a wall"));
}

// Too little covered is a failure without an event.
TEST_F(CampaignTest, TooLittleCoveredIsAFailure) {
  Write("success: {min_coverage: 1}\n");
  ASSERT_EQ(Campaign("-n 8 --out a").status, 0);
  const Json variant = Json::parse(Slurp(folder_ / "a/summary.json"))["variants"]["default"];
  EXPECT_EQ(variant["outcomes"]["success"], 0);
  EXPECT_EQ(variant["failures"]["any_failure"]["k"], variant["outcomes"]["failure"]);
  EXPECT_EQ(variant["failures"]["not_success"]["k"], 8) << "timeouts too";
  EXPECT_EQ(variant["by_kind"]["coverage"]["k"],
            Count("a", "SELECT count(*) FROM episode WHERE outcome = 'failure' AND events = '[]'"));
  EXPECT_GT(variant["by_kind"]["coverage"]["k"], 0);
  EXPECT_EQ(Campaign("-n 50 --fail-fast --out b").status, 1);
  EXPECT_EQ(Count("b", "SELECT max(episode) FROM episode"),
            Count("a", "SELECT min(episode) FROM episode WHERE outcome = 'failure'"));
}

// Half of the episodes ask for a circle that fits nowhere.
TEST_F(CampaignTest, NoPlanIsNoSuccess) {
  Write("drive: none\ngate: {metric: not_success, max_rate: 0.2, confidence: 0.9}\n",
        "  plan.radius_m: {choice: [0.18, 5]}\n");
  std::string text = Slurp(folder_ / "s.yaml");
  text.replace(text.find("plan: {file: p.csv}"), 19, "plan: boustrophedon");
  std::ofstream(folder_ / "s.yaml") << text;
  EXPECT_EQ(Campaign("-n 40 --out a").status, 1) << "the gate fails";
  const Json summary = Json::parse(Slurp(folder_ / "a/summary.json"));
  const Json& variant = summary["variants"]["default"];
  const Json& gate = summary["gate"]["variants"]["default"];
  EXPECT_GT(variant["n_not_planned"], 0);
  EXPECT_EQ(gate["n"], variant["n_not_planned"].get<int>() + variant["n"].get<int>());
  EXPECT_EQ(gate["k"], variant["n_not_planned"]);
  EXPECT_TRUE(variant["failures"]["stuck"]["rate"].is_null()) << "nothing was driven";
}

TEST_F(CampaignTest, WithoutPhysicsNoFailureModeCanBeJudged) {
  Write("drive: none\ngate: {metric: stuck, max_rate: 0.6, confidence: 0.9}\n");
  const Ended refused = Campaign("-n 5 --out a");
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.said, HasSubstr("gate.metric = stuck: must be not_success"));
}

TEST_F(CampaignTest, OfTwoStartsOnOneFolderOneGoesOn) {
  for (const char* cwd : {"1", "2"}) std::filesystem::create_directories(folder_ / cwd);
  const std::string arguments = "campaign ../s.yaml --no-films -n 20 --jobs 1 --out ../o";
  Program first(arguments, folder_ / "1"), second(arguments, folder_ / "2");
  const int statuses[] = {first.Wait(), second.Wait()};
  ASSERT_TRUE((statuses[0] == 2) != (statuses[1] == 2)) << statuses[0] << ", " << statuses[1];
  const Program& other = statuses[0] == 2 ? first : second;
  EXPECT_THAT(other.Said(),
              ::testing::AnyOf(HasSubstr("is in use"), HasSubstr("holds a campaign")));
  EXPECT_EQ(Count("o", "SELECT count(*) FROM episode"), 20);
}

TEST_F(CampaignTest, AFolderFromAnotherMachineReplays) {
  ASSERT_NE(Campaign("-n 3 --out a/b/o").status, 2);
  std::filesystem::rename(folder_ / "a/b/o", folder_ / "o");
  std::filesystem::remove(folder_ / "p.csv");
  std::filesystem::remove(folder_ / "s.yaml");
  const Ended dut = Run("replay o --episode 2");
  EXPECT_EQ(dut.status, 0) << dut.said;
}

TEST_F(CampaignTest, AFixedGateIsNotLookedAtTwice) {
  Write("gate: {metric: not_success, max_rate: 0.5, confidence: 0.95}\n");
  ASSERT_NE(Campaign("-n 6 --out a").status, 2);
  const Ended again = Campaign("-n 12 --resume --out a");
  EXPECT_EQ(again.status, 2);
  EXPECT_THAT(again.said, HasSubstr("the fixed gate was judged at 6 episodes"));
  // What was not judged may grow.
  ASSERT_EQ(Campaign("-n 6 --time-limit 0.01 --out b").status, 4);
  EXPECT_NE(Campaign("-n 12 --resume --out b").status, 2);
}

TEST_F(CampaignTest, AKeyThatIsNoneIsRefusedBeforeAnythingIsDriven) {
  for (const auto& [drawn, says] :
       {std::pair("  site.floor.frction: {uniform: [0.4, 1.0]}\n", "frction"),
        {"  robot: {choice: [beluga, belugaa]}\n", "belugaa"},
        {"  site.hazards.sil.height_m: {uniform: [0.004, 0.03]}\n", "sil"}}) {
    Write("", drawn);
    const Ended refused = Campaign("-n 5 --out a");
    EXPECT_EQ(refused.status, 2) << drawn;
    EXPECT_THAT(refused.said, HasSubstr(says));
    EXPECT_FALSE(fs::exists(folder_ / "a"));
  }
}

TEST_F(CampaignTest, WhatACampaignLeavesIsWholeInOneFile) {
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_EQ(Campaign("-n 6 --out a").status, 0);
  const auto six = std::chrono::steady_clock::now() - begin;
  Program dut("campaign s.yaml --no-films -n 100000 --jobs 2 --out b", folder_);
  dut.AWorker();
  std::this_thread::sleep_for(six);
  dut.Send(SIGINT);
  ASSERT_EQ(dut.Wait(), 130);
  fs::create_directory(folder_ / "copy");
  fs::copy(folder_ / "b/campaign.sqlite", folder_ / "copy/campaign.sqlite");
  EXPECT_GT(Count("b", "SELECT count(*) FROM episode"), 0);
  EXPECT_EQ(Count("copy", "SELECT count(*) FROM episode"),
            Count("b", "SELECT count(*) FROM episode"));
}

// The settings that a replayed episode leaves are that episode's, draws and noise alike.
TEST_F(CampaignTest, AReplayedEpisodesSettingsGiveItAgain) {
  Write("matrix: {start.yaw_deg: [0, 10]}\n");
  ASSERT_EQ(Campaign("-n 4 --out a").status, 0);
  ASSERT_EQ(Run("replay a --episode 3 --variant yaw_deg=10").status, 0);
  const std::string episode = "a/episodes/yaw_deg=10/3/";
  EXPECT_LE(Run("run " + episode + "scenario.resolved.yaml --out again").status, 1);
  EXPECT_EQ(Slurp(folder_ / "again/result.json"), Slurp(folder_ / (episode + "result.json")));
  EXPECT_EQ(Slurp(folder_ / "again/trace.csv"), Slurp(folder_ / (episode + "trace.csv")));
}

TEST_F(CampaignTest, FailingEpisodesAreListedWithTheirCommands) {
  ASSERT_EQ(Campaign("-n 8 --out a").status, 0);
  std::istringstream list(Slurp(folder_ / "a/failing_episodes.csv"));
  int lines = -1;
  for (std::string line; std::getline(list, line); ++lines)
    if (lines >= 0) {
      EXPECT_THAT(line, HasSubstr("floorproof replay a --episode "));
    }
  EXPECT_EQ(lines, Count("a", "SELECT count(*) FROM episode WHERE outcome != 'success'"));
  EXPECT_THAT(Slurp(folder_ / "a/dependence.csv"),
              ::testing::StartsWith("variant,value,low,high,n,k,rate"));
}

// Errors may be the machine's: memory ran out, someone killed it.
TEST_F(CampaignTest, ErrorsAreDrivenAgainWhenAsked) {
  Write("", "  start.x_m: {uniform: [0.1, 0.7]}\n");
  ASSERT_EQ(Campaign("-n 4 --out a").status, 3);
  const std::string before = Dump("a");
  ASSERT_EQ(Campaign("-n 4 --resume --retry-errors --out a").status, 3);
  EXPECT_EQ(Dump("a"), before);
}

// A shard driven elsewhere must not differ by its folder's name.
TEST_F(CampaignTest, AnErrorsMessageIsTheSameInEachFolder) {
  Write("", "  start.x_m: {uniform: [0.1, 0.7]}\n");
  ASSERT_EQ(Campaign("-n 2 --out a").status, 3);
  EXPECT_EQ(Run("campaign --no-films " + (folder_ / "s.yaml").string() + " -n 2 --out b").status,
            3);
  ExpectSameResults("a", "b");
  EXPECT_THAT(Select("a", "SELECT message FROM episode"), HasSubstr("s.yaml:"));
}

TEST_F(CampaignTest, RatesPerPlaceAreOfTheEpisodesThatFailedThere) {
  ASSERT_EQ(Campaign("-n 8 --out a").status, 0);
  const Json variant = Json::parse(Slurp(folder_ / "a/summary.json"))["variants"]["default"];
  const Json& places = variant["by_place"]["places"];
  const double half_m = variant["by_place"]["cell_m"].get<double>() / 2;
  ASSERT_FALSE(places.empty());
  int failed = 0;
  const CampaignStore store = CampaignStore::Open(folder_ / "a/campaign.sqlite", false);
  store.ForEach("default", [&](const EpisodeRow& row) {
    const Json events = Json::parse(row.events);
    for (const Json& event : events)
      EXPECT_TRUE(std::ranges::any_of(places, [&](const Json& place) {
        return std::abs(event["x_m"].get<double>() - place["x_m"].get<double>()) <= half_m &&
               std::abs(event["y_m"].get<double>() - place["y_m"].get<double>()) <= half_m;
      })) << event;
    failed += !events.empty();
  });
  int most = 0, all = 0;
  for (const Json& place : places) {
    EXPECT_EQ(place["n"], 8);
    most = std::max(most, place["k"].get<int>());
    all += place["k"].get<int>();
  }
  EXPECT_LE(most, failed) << "an episode counts once in a place";
  EXPECT_GE(all, failed);
}

TEST_F(CampaignTest, CtrlCIsOneLineAndStatus130) {
  ASSERT_EQ(Campaign("-n 12 --jobs 2 --out whole").status, 0);
  Program dut("campaign s.yaml --no-films -n 12 --jobs 2 --out o", folder_);
  dut.AWorker();
  usleep(200'000);
  const std::vector<pid_t> workers = dut.Workers();
  dut.Send(SIGINT);
  EXPECT_EQ(dut.Wait(), 130);
  EXPECT_TRUE(dut.Said().starts_with("floorproof: interrupted: ")) << dut.Said();
  EXPECT_THAT(dut.Said(), HasSubstr("--resume goes on"));
  EXPECT_EQ(std::ranges::count(dut.Said(), '\n'), 1) << dut.Said();
  for (const pid_t worker : workers) EXPECT_NE(kill(worker, 0), 0) << "a worker lives on";
  EXPECT_TRUE(Json::accept(Slurp(folder_ / "o/summary.json")));
  ASSERT_EQ(Campaign("-n 12 --jobs 2 --out o --resume").status, 0);
  ExpectSameResults("whole", "o");
}

TEST_F(CampaignTest, CtrlCEndsTheProgramsThatPlanAndTakesTheirFoldersAway) {
  PlanBy("echo $$ > note.$$; echo \"$1\" >> note.$$; mv note.$$ at.$$; sleep 1000\n");
  Program dut("campaign s.yaml --trust --no-films -n 4 --jobs 2 --out o", folder_);
  std::vector<std::filesystem::path> notes;
  while (notes.size() < 2 && !dut.HasEnded()) {
    usleep(1000);
    notes.clear();
    for (const auto& entry : std::filesystem::directory_iterator(folder_))
      if (entry.path().stem() == "at") notes.push_back(entry.path());
  }
  ASSERT_EQ(notes.size(), 2u) << dut.Said();
  dut.Send(SIGINT);
  EXPECT_EQ(dut.Wait(), 130);
  for (const auto& note : notes) {
    pid_t program = 0;
    std::string exchange;
    std::ifstream(note) >> program >> exchange;
    ASSERT_GT(program, 0);
    const auto there = [&] { return kill(program, 0) == 0 || std::filesystem::exists(exchange); };
    for (int i = 0; i < 2000 && there(); ++i) usleep(1000);  // their guards tidy up
    EXPECT_FALSE(there()) << exchange;
  }
}

}  // namespace
}  // namespace floorproof
