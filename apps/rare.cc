// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "apps/campaign_line.h"
#include "base/file_output.h"
#include "base/quantity.h"
#include "report/rare_films.h"
#include "report/rare_page.h"
#include "run/rare/rare_json.h"
#include "run/scenario/scenario_file.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

struct RareCommand : CampaignArguments {
  std::string scenario, mode = "any_failure";
  std::optional<double> target_cov = RareSettings{}.target_cov;
  bool retry_errors = false, no_films = false;
};

class RareLine final : public RareObserver {
 public:
  RareLine(const Globals& globals, std::uint64_t most)
      : globals_(globals), line_(globals), most_(most) {}
  void OnWarning(const std::string& line) override { globals_.Say(line); }
  void OnProgress(const std::string& stage, const RareProgress& p) override {
    if (!line_.IsDue()) return;
    const double rate = static_cast<double>(p.driven) / std::max(line_.wall_s(), 1e-3);
    std::string text = fmt::format(
        "  {} of at most {}, {} a second; {}; {} so far", FixedText(static_cast<double>(p.done), 0),
        CountText(most_, "drive"), FixedText(rate, 1), stage, CountText(p.failures, "failure"));
    if (rate > 0 && p.done < most_)
      text += "; at most " + TimeText(static_cast<double>(most_ - p.done) / rate) + " to go";
    line_.Show(text);
  }
  void Clear() { line_.Clear(); }

 private:
  const Globals& globals_;
  ProgressLine line_;
  std::uint64_t most_;
};

// A drive that was none counts as no failure: no gate passes on that.
int ExitStatusOf(const RareOutcome& outcome) {
  if (outcome.errors > 0) return kExitBroken;
  if (outcome.verdict && outcome.verdict->verdict == GateVerdict::kFailed) return kExitNotSuccess;
  if (outcome.verdict && outcome.verdict->verdict == GateVerdict::kPassed) return kExitDone;
  if (outcome.verdict) return kExitUndecided;
  return outcome.estimate.answer == RareAnswer::kNoEstimate ? kExitUndecided : kExitDone;
}

int RunRare(const RareCommand& options, const Globals& globals) {
  const ScenarioFile file(options.scenario, OverridesOf(globals, options), globals.trust());
  const fs::path folder =
      options.out.empty() ? fs::path("out") / "rare" / file.file().stem() : fs::path(options.out);
  const RareRequest request{
      .mode = options.mode,
      .settings = {.target_cov = *options.target_cov, .max_trials = options.n},
      .jobs = RequestOf(options).jobs,
      .resume = options.resume,
      .retry_errors = options.retry_errors};
  RareLine progress(globals, options.n);
  const RareOutcome outcome = SearchRare(file, request, folder, &progress);
  progress.Clear();
  globals.Result(RareJson(outcome));
  for (const std::string& line : RareLines(outcome, folder)) globals.Say(line);
  globals.SayFact("Results", folder.string());
  const auto write_page = [&] {
    WriteFileWhole(folder / "rare.html", MakeRarePage(folder).html);
    globals.SayFact("Page", (folder / "rare.html").string());
  };
  try {
    if (!options.no_films) FilmLikelyFailures(file, outcome, folder, globals);
  } catch (const std::runtime_error& e) {  // the answer stands without them
    write_page();
    throw InternalError(std::string(e.what()) + "; missing: films of the likeliest failures");
  }
  write_page();
  return ExitStatusOf(outcome);
}

}  // namespace

void AddRare(CommandLine& line, const Globals& globals, int& status) {
  auto options = std::make_shared<RareCommand>();
  options->n = RareSettings{}.max_trials;
  Subcommand command = line.Add(
      "rare",
      "How likely rare failures are, by a search that drives towards them; the likeliest filmed");
  command.Text("SCENARIO", options->scenario, "Scenario file (YAML)", Subcommand::Need::kRequired);
  command.Text("--mode", options->mode,
               "What counts: veer_off, stuck, roll_over, bounce_back or any_failure (default)");
  command.Number("--target-cov", options->target_cov,
                 "Coefficient of variation that the estimate should have (default: 0.1)", 0.01, 1);
  command.Integer("--max-n", options->n, "Most drives (default: 15,000)", 1, 10'000'000);
  command.NonNegative("--seed", options->seed, "Overrides the scenario's seed");
  command.Integer("--jobs", options->jobs, "Worker processes (default: one a core)", 1, kMostJobs);
  command.Text("--out", options->out, "Output folder (default: out/rare/NAME)");
  command.Flag("--resume", options->resume, "Go on with the search that the folder holds");
  command.Flag("--retry-errors", options->retry_errors,
               "With --resume: drive again what ended in an error, and all that came after it");
  command.Flag("--no-films", options->no_films, "Do not film the likeliest failures");
  command.OnRun([options, &globals, &status] { status = RunRare(*options, globals); });
}

}  // namespace floorproof
