// SPDX-License-Identifier: Apache-2.0
#include "run/campaign/campaign.h"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "apps/campaign_results.h"
#include "apps/command.h"
#include "base/file_output.h"
#include "base/interrupt.h"
#include "base/progress_line.h"
#include "report/campaign_films.h"
#include "run/campaign/campaign_about.h"
#include "run/scenario/warnings.h"
#include "stats/binomial.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string scenario, out, episodes;
  std::uint64_t n = 0;
  int seed = -1, jobs = 0;
  std::optional<double> time_limit_s;
  bool resume = false, retry_errors = false, fail_fast = false, no_films = false;
};

// A:B, half-open; all of 0:n where it is empty.
void ReadEpisodes(const Options& options, CampaignOptions& campaign) {
  campaign.end = options.n;
  if (options.episodes.empty()) return;
  const auto refuse = [&](const char* rule) {
    throw InputError({"--episodes", 0}, "", options.episodes, rule);
  };
  unsigned long long a = 0, b = 0;
  int used = 0;
  if (std::sscanf(options.episodes.c_str(), "%llu:%llu%n", &a, &b, &used) != 2 ||
      static_cast<std::size_t>(used) != options.episodes.size())
    refuse("must be A:B, the first id and the one behind the last");
  if (a >= b) refuse("holds no episode");
  if (b > options.n) refuse("must lie within -n");
  campaign.begin = a;
  campaign.end = b;
}

// How it goes: what is done, the rates so far, time to go.
class Progress final : public CampaignObserver {
 public:
  Progress(const Globals& globals, const std::vector<Variant>& variants)
      : line_(globals), variants_(variants) {}
  void OnProgress(const CampaignProgress& progress) override {
    if (line_.IsDue()) line_.Show(Text(progress));
  }
  void Clear() { line_.Clear(); }

 private:
  std::string Text(const CampaignProgress& p) const {
    std::string text = fmt::format("  {} of {} episodes", p.done, p.total);
    if (p.done_now > 0) {
      const double rate = static_cast<double>(p.done_now) / p.elapsed_s;
      text += fmt::format(", {:.1f} a second, {:.0f} s to go at most", rate,
                          static_cast<double>(p.total - p.done) / rate);
    }
    constexpr std::size_t kShown = 3;
    for (std::size_t v = 0; v < std::min(kShown, p.variants.size()); ++v) {
      const VariantProgress& at = p.variants[v];
      if (at.n == 0) continue;
      text +=
          fmt::format("; {}{} of {} fail (at most {:.2g} %)",
                      p.variants.size() > 1 ? variants_[v].name + ": " : "", at.any_failure, at.n,
                      100 * ClopperPearsonUpper(static_cast<int>(at.any_failure),
                                                static_cast<int>(at.n), kReportedConfidence));
    }
    return text;
  }

  ProgressLine line_;
  const std::vector<Variant>& variants_;
};

CampaignStore OpenStore(const fs::path& folder, const CampaignAbout& about, bool resume) {
  const fs::path file = folder / "campaign.sqlite";
  std::error_code ignored;
  if (!fs::exists(file, ignored)) {
    MakeFolder(folder);
    return CampaignStore::Create(file, about);
  }
  if (!resume)
    throw InputError({folder.string(), 0}, "", "",
                     "holds a campaign: --resume goes on with it, --out names another folder");
  CampaignStore store = CampaignStore::Open(file, false);
  RequireSame(store.about(), about, file);
  store.MakeWritable();  // another campaign's is not so much as opened to be written
  return store;
}

// A fixed gate is judged once, at an n set beforehand: going on because it did not pass would pass
// falsely far more often than it says.
void RefuseSecondLook(CampaignStore& store, const ScenarioFile& file, std::uint64_t n) {
  const std::uint64_t before = store.asked();
  if (before == 0 || n <= before) return;
  const auto gate = CampaignGate::Read(file.gate(), before, file.drives());
  if (!gate || !gate->fixed()) return;
  CampaignOptions nothing_more;
  nothing_more.end = before;
  nothing_more.jobs = 0;
  nothing_more.gate = gate;
  const CampaignRun then = RunCampaign(file, store, nothing_more);
  const bool judged =
      std::ranges::all_of(then.variants, [](const auto& v) { return v.gate->decided(); });
  if (judged)
    throw InputError({"-n", 0}, "", std::to_string(n),
                     fmt::format("the fixed gate was judged at {} episodes; only a gate of `mode: "
                                 "sequential` may go on",
                                 before));
}

int RunIt(const Options& options, const Globals& globals) {
  auto overrides = globals.Overrides();
  if (options.seed >= 0) overrides.push_back({"seed", std::to_string(options.seed)});
  CampaignOptions campaign;
  campaign.fail_fast = options.fail_fast;
  campaign.jobs = options.jobs > 0
                      ? options.jobs
                      : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  campaign.time_limit_s = options.time_limit_s;
  ReadEpisodes(options, campaign);

  const ScenarioFile file(options.scenario, overrides);
  const Scenario base = file.Read(std::nullopt);
  const fs::path folder = OutputFolder(options.out, base);
  SayWhenInterrupted(folder.string() + " is as before");
  for (const std::string& warning : Warnings(base)) globals.Say(warning);
  const CampaignAbout about = DescribeCampaign(file);
  const std::vector<Variant>& variants = file.variants();
  // Refused before there is a folder.
  const auto gate = CampaignGate::Read(base.gate, options.n, file.drives());
  file.CheckDraws();
  if (options.episodes.empty()) campaign.gate = gate;

  const HoldInterrupts hold;
  std::optional<CampaignStore> opened = OpenStore(folder, about, options.resume);
  CampaignStore& store = *opened;
  RefuseSecondLook(store, file, options.n);
  store.SetAsked(options.n);
  if (options.retry_errors) store.DropErrors();
  SayWhenInterrupted(folder.string() + " holds every episode saved so far; --resume goes on");
  WriteFileWhole(folder / "scenario.resolved.yaml", ResolvedScenario(base, folder));
  Progress progress(globals, variants);
  const CampaignRun run = RunCampaign(file, store, campaign, &progress);
  progress.Clear();
  const int status = SayResults(file, store, run, folder, globals);
  if (!options.episodes.empty() && gate) globals.Say("a shard: `merge` judges the gate of all");
  if (run.end == CampaignEnd::kInterrupted) {
    opened.reset();  // closed as it should be, no file beside it
    throw Interruption();
  }
  if (!options.no_films && run.end != CampaignEnd::kTimeLimit)
    FilmFirstFailures(file, store, folder, globals);
  return status;
}

}  // namespace

void AddCampaign(CommandLine& line, const Globals& globals, int& status) {
  auto options = std::make_shared<Options>();
  Subcommand command = line.Add(
      "campaign", "Drive many episodes on all cores: failure rates with intervals, a gate for CI");
  command.Text("SCENARIO", options->scenario, "Scenario file (YAML)", Subcommand::Need::kRequired);
  command.Integer("-n", options->n, "Episodes a variant", 1, 100'000'000,
                  Subcommand::Need::kRequired);
  command.NonNegative("--seed", options->seed, "Overrides the scenario's seed");
  command.Integer("--jobs", options->jobs, "Worker processes (default: one a core)", 1, 1024);
  command.Text("--episodes", options->episodes,
               "A:B, ids from A to before B only: a shard for `merge`; its gate is judged there");
  command.Text("--out", options->out, "Output folder (default: out/<scenario's stem>)");
  command.Flag("--resume", options->resume, "Go on with the campaign that the folder holds");
  command.Flag("--retry-errors", options->retry_errors,
               "With --resume: drive again what ended in an error");
  command.Flag("--fail-fast", options->fail_fast, "End at the first episode that fails (status 1)");
  command.Number("--time-limit", options->time_limit_s,
                 "Seconds of wall time; nothing is filmed then", 0.001, 1e9);
  command.Flag("--no-films", options->no_films, "Do not film the first failure of each mode");
  command.OnRun([options, &globals, &status] { status = RunIt(*options, globals); });
}

}  // namespace floorproof
