// SPDX-License-Identifier: Apache-2.0
#include "run/campaign/drive_campaign.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <set>

#include "base/file_output.h"
#include "base/quantity.h"
#include "run/campaign/campaign_about.h"
#include "run/campaign/campaign_files.h"
#include "run/scenario/chance.h"
#include "run/scenario/resolved_scenario.h"
#include "run/scenario/scenario_file.h"
#include "run/scenario/warnings.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDatabase = "campaign.sqlite";

bool HoldsCampaign(const fs::path& folder, bool resume) {
  return HoldsDatabase(folder, kDatabase, "a campaign", resume);
}

// A fixed gate is judged once, at an n set beforehand: going on because it did not pass would pass
// falsely far more often than it says.
void RefuseSecondLook(CampaignStore& store, const ScenarioFile& file, std::uint64_t n) {
  const std::uint64_t before = store.asked();
  if (before == 0 || n <= before) return;
  const auto gate = CampaignGate::Read(file.gate(), before, file.drives());
  if (!gate || !gate->fixed()) return;
  const CampaignRun then = RunCampaign(file, store, {.end = before, .gate = gate, .jobs = 0});
  const bool judged =
      std::ranges::all_of(then.variants, [](const auto& v) { return v.gate->decided(); });
  if (judged)
    throw InputError({"-n", 0}, "", std::to_string(n),
                     fmt::format("the fixed gate was judged at {}; only a gate of `mode: "
                                 "sequential` may go on",
                                 CountText(before, "episode")));
}

// Episodes between which nothing differs are one: that it fails or not says nothing of how often.
// What is judged on it is refused, else it is said.
void CheckChance(const ScenarioFile& file, const ConfigNode& gate, CampaignObserver* observer) {
  for (const Variant& variant : file.variants()) {
    if (EpisodesCanDiffer(file, file.Read(std::nullopt, variant))) continue;
    const std::string of = file.variants().size() > 1 ? " of " + variant.name : "";
    const std::string why = fmt::format(
        "nothing differs between the episodes{}: they are one, repeated, which says nothing of how "
        "often it fails; {}",
        of, kHowToDiffer);
    if (!gate.IsNull()) throw InputError(gate.mark, "gate", "", why);
    if (observer) observer->OnWarning("warning: " + why);
    return;
  }
}

// Draws that cannot be driven, such as a start in a wall, are errors. The rate is then that of
// another scenario than was meant. Reads the first episodes, for one second at most.
void WarnOfErrors(const ScenarioFile& file, std::uint64_t episodes, CampaignObserver* observer) {
  if (observer == nullptr || !file.draws_differ()) return;
  constexpr std::uint64_t kMostTried = 100;
  constexpr double kMaxShare = 0.03, kBudget_s = 1;
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(kBudget_s);
  int tried = 0, errors = 0;
  std::string first;
  for (std::uint64_t k = 0; k < std::min(episodes, kMostTried); ++k)
    for (const Variant& variant : file.variants()) {
      if (tried > 0 && Clock::now() > end) break;
      ++tried;
      try {
        file.Read(k, variant);
      } catch (const InputError& e) {
        if (errors++ == 0) first = e.what();
      }
    }
  if (errors > kMaxShare * tried)
    observer->OnWarning(fmt::format(
        "warning: {} of the first {} cannot be driven and will end as errors; the first error: {}",
        errors, CountText(tried, "draw"), first));
}

// Which programs its variants have plan for them. Throws InputError where one is not there.
void SayPrograms(const ScenarioFile& file, CampaignObserver* observer) {
  std::set<std::string> said;
  for (const Variant& variant : file.variants()) {
    const Scenario s = file.Read(std::nullopt, variant);
    const std::string line = ProgramAnnounced(s);
    if (!line.empty() && said.insert(line).second && observer) observer->OnWarning(line);
  }
}

// What is asked for is right, yet its results do not reach the disk: the tool has failed, and says
// what is not there.
template <class Error, class Write>
auto Keep(const char* missing, const Write& write) {
  try {
    return write();
  } catch (const Error& e) {
    throw InternalError(fmt::format("{}; missing: {}", e.what(), missing));
  }
}

void CheckRequest(const CampaignRequest& request) {
  if (request.episodes < 1 || request.episodes > kMostEpisodes)
    throw InputError({"-n", 0}, "", std::to_string(request.episodes),
                     fmt::format("must be in [1, {}]", kMostEpisodes));
  if (request.jobs < 1 || request.jobs > kMostJobs)
    throw InputError({"--jobs", 0}, "", std::to_string(request.jobs),
                     fmt::format("must be in [1, {}]", kMostJobs));
  if (request.time_limit_s && !(*request.time_limit_s > 0))
    throw InputError({"--time-limit", 0}, "", FormatDouble(*request.time_limit_s), "must be > 0");
  if (!request.shard) return;
  const auto [begin, end] = *request.shard;
  const auto refuse = [begin = begin, end = end](const char* rule) {
    throw InputError({"--episodes", 0}, "", fmt::format("{}:{}", begin, end), rule);
  };
  if (begin >= end) refuse("holds no episode");
  if (end > request.episodes) refuse("must lie within -n");
}

}  // namespace

CampaignOutcome DriveCampaign(const ScenarioFile& file, const CampaignRequest& request,
                              const fs::path& folder, CampaignObserver* observer) {
  CheckRequest(request);
  const Scenario base = file.Read(std::nullopt);
  SayWhenInterrupted(folder.string() + " is as before");
  if (observer)
    for (const std::string& warning : Warnings(base)) observer->OnWarning(warning);
  const CampaignAbout about = DescribeCampaign(file);
  // Refused before there is a folder.
  if (request.episodes > 1)
    CheckChance(file, base.text.gate, observer);  // no number would mend that
  const auto gate = CampaignGate::Read(base.text.gate, request.episodes, file.drives());
  SayPrograms(file, observer);
  WarnOfErrors(file, request.episodes, observer);

  auto hold = std::make_unique<HoldInterrupts>();
  HoldsCampaign(folder, request.resume);
  auto out = std::make_unique<ResultFolder>(folder, CampaignResults(), file.files().All());
  // A folder that is refused is bad input, and nothing is missing.
  CampaignStore store = Keep<DiskError>("every episode that is not in campaign.sqlite", [&] {
    out->Lock();
    const bool there = HoldsCampaign(folder, request.resume);  // another may have begun it since
    CampaignStore opened = OpenOrCreate(folder / kDatabase, about, there);
    RefuseSecondLook(opened, file, request.episodes);
    opened.SetAsked(request.episodes);
    if (request.retry_errors) opened.DropErrors();
    out->Begin();
    return opened;
  });
  SayWhenInterrupted(folder.string() + " holds every episode saved so far; --resume goes on");
  Keep<std::runtime_error>("scenario.resolved.yaml and every episode; --resume goes on",
                           [&] { WriteResolvedScenario(base, folder, file.files().All()); });
  ReplayShelf shelf(folder);
  CampaignOptions options{.end = request.episodes,
                          .gate = gate,
                          .jobs = request.jobs,
                          .pool = request.pool,
                          .replays = request.replays ? &shelf : nullptr,
                          .fail_fast = request.fail_fast,
                          .time_limit_s = request.time_limit_s};
  if (request.shard) {
    options.begin = request.shard->begin;
    options.end = request.shard->end;
    options.gate = {};  // judged on the whole campaign
  }
  CampaignRun run = Keep<std::runtime_error>(
      "the episodes that are not in campaign.sqlite, and all that is made from them; --resume goes "
      "on",
      [&] { return RunCampaign(file, store, options, observer); });
  CampaignSummary summary = Keep<std::runtime_error>(
      "some of episodes.csv, junit.xml, summary.json and the films; --resume goes on",
      [&] { return WriteSummaryFiles(store, file, run, folder); });
  store.RequireInPlace();
  out->RequireInPlace({kDatabase, "scenario.resolved.yaml", "summary.json"});
  return {std::move(hold), std::move(out), std::move(store),
          file.variants(), std::move(run), std::move(summary)};
}

}  // namespace floorproof
