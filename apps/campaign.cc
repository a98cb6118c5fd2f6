// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "apps/campaign_line.h"
#include "base/interrupt.h"
#include "report/campaign_films.h"
#include "report/campaign_report.h"
#include "report/campaign_words.h"
#include "run/campaign/drive_campaign.h"
#include "run/campaign/summary_json.h"
#include "run/scenario/scenario_file.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

struct CampaignCommand : CampaignArguments {
  std::string scenario;
  std::optional<double> time_limit_s;
  bool retry_errors = false, fail_fast = false, no_films = false, no_replays = false;
};

int RunTheCampaign(const CampaignCommand& options, const Globals& globals) {
  CampaignRequest request = RequestOf(options);
  request.retry_errors = options.retry_errors;
  request.fail_fast = options.fail_fast;
  request.replays = !options.no_replays;
  request.time_limit_s = options.time_limit_s;
  const ScenarioFile file(options.scenario, OverridesOf(globals, options), globals.trust());
  const fs::path folder = CampaignFolder(options.out, file.file(), file.name());
  CampaignLine progress(globals, file.variants());
  CampaignOutcome outcome = DriveCampaign(file, request, folder, &progress);
  progress.Clear();
  const bool draws = !options.no_films && outcome.run.end != CampaignEnd::kInterrupted &&
                     outcome.run.end != CampaignEnd::kTimeLimit;
  const char* missing = "dependence.csv, failing_episodes.csv, films and page";
  try {
    globals.Result(SummaryJson(outcome.summary));
    SayCampaign(outcome, folder, globals, draws && !request.shard);
    if (request.shard && !file.gate().IsNull())
      globals.Say("a shard: `merge` judges the gate of all");
    if (outcome.run.end == CampaignEnd::kInterrupted) throw Interruption();
    missing = "films of the first failures, and the page";
    if (draws) FilmFirstFailures(file, outcome.store, folder, globals);
    missing = "the page";
    if (draws && !request.shard) {
      // The page is made from what is recorded alone, which is let go of for it.
      outcome.folder.reset();
      { const CampaignStore whole = std::move(outcome.store); }
      globals.SayFact("Page", WriteCampaignReport(folder, folder.string(), globals).page.string());
    }
  } catch (const std::runtime_error& e) {
    throw InternalError(std::string(e.what()) + "; missing: " + missing);
  }
  SayQuietErrors(outcome.summary, globals);
  return CampaignExitStatus(outcome);
}

}  // namespace

void AddCampaign(CommandLine& line, const Globals& globals, int& status) {
  auto options = std::make_shared<CampaignCommand>();
  Subcommand command = line.Add(
      "campaign", "Drive many episodes on all cores: failure rates with intervals, a gate for CI");
  command.Text("SCENARIO", options->scenario, "Scenario file (YAML)", Subcommand::Need::kRequired);
  command.Integer("-n", options->n, "Episodes a variant", 1, kMostEpisodes,
                  Subcommand::Need::kRequired);
  command.NonNegative("--seed", options->seed, "Overrides the scenario's seed");
  command.Integer("--jobs", options->jobs, "Worker processes (default: one a core)", 1, kMostJobs);
  command.Text("--episodes", options->episodes,
               "A:B, ids from A to before B only: a shard for `merge`; its gate is judged there");
  command.Text("--out", options->out, kOutputHelp);
  command.Flag("--resume", options->resume, "Go on with the campaign that the folder holds");
  command.Flag("--retry-errors", options->retry_errors,
               "With --resume: drive again what ended in an error");
  command.Flag("--fail-fast", options->fail_fast, "End at the first episode that fails (status 1)");
  command.Number("--time-limit", options->time_limit_s,
                 "Seconds of wall time; nothing is drawn then", 0.001, 1e9);
  command.Flag("--no-films", options->no_films,
               "Draw nothing: no film of each mode's first failure, no page");
  command.Flag("--no-replays", options->no_replays,
               "Do not keep the replays of failing episodes for the page (100 a variant)");
  command.OnRun([options, &globals, &status] { status = RunTheCampaign(*options, globals); });
}

}  // namespace floorproof
