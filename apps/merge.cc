// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "apps/campaign_results.h"
#include "apps/command.h"
#include "base/file_output.h"
#include "base/input_file.h"
#include "base/interrupt.h"
#include "run/campaign/campaign_about.h"
#include "run/campaign/campaign_merge.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

// The settings with their paths valid from `out`; as they are where what they name is gone.
std::string SettingsFor(const fs::path& out, const ScenarioFile& scenario, const fs::path& recorded,
                        const Globals& globals) try {
  return ResolvedScenario(scenario.Read(std::nullopt), out);
} catch (const InputError& e) {
  globals.Say(fmt::format("{}: its paths hold from {}, not from here ({})",
                          (out / "scenario.resolved.yaml").string(),
                          recorded.parent_path().string(), e.what()));
  return ReadInputFile(recorded, kMaxResultBytes);
}

bool IsFixed(const ScenarioFile& scenario, std::uint64_t n) {
  const auto gate = CampaignGate::Read(scenario.gate(), n, scenario.drives());
  return gate && gate->fixed();
}

// "60:70, 80:81", half-open, of 0:end.
std::string Missing(const std::vector<std::uint64_t>& there, std::uint64_t end) {
  std::string text;
  std::uint64_t next = 0;
  const auto gap = [&](std::uint64_t to) {
    if (to > next) text += fmt::format("{}{}:{}", text.empty() ? "" : ", ", next, to);
    next = to + 1;
  };
  for (const std::uint64_t episode : there) gap(std::min(episode, end));
  gap(end);
  return text;
}

int Merge(const std::vector<std::string>& shards, const fs::path& out, const Globals& globals) {
  const fs::path file = out / "campaign.sqlite";
  std::error_code ignored;
  if (fs::exists(file, ignored))
    throw InputError({out.string(), 0}, "", "", "holds a campaign: --out names another folder");
  SayWhenInterrupted(out.string() + " is as before, or holds part of the shards");
  std::vector<CampaignStore> from;
  for (const std::string& shard : shards) {
    from.push_back(CampaignStore::Open(fs::path(shard) / "campaign.sqlite", false));
    RequireSame(from.front().about(), from.back().about(), shard);
  }
  const fs::path recorded = fs::path(shards.front()) / "scenario.resolved.yaml";
  const ScenarioFile scenario = ScenarioFile::Recorded(recorded);
  const std::vector<Variant>& variants = scenario.variants();
  CheckOverlaps(from, shards, variants);
  for (std::size_t i = 1; i < from.size(); ++i)
    if (from[i].asked() != from[0].asked() && IsFixed(scenario, from[i].asked()))
      throw InputError({shards[i], 0}, "-n", std::to_string(from[i].asked()),
                       fmt::format("{} was driven with -n {}: a fixed gate is judged at one n",
                                   shards[0], from[0].asked()));

  const HoldInterrupts hold;
  MakeFolder(out);
  CampaignStore store = CampaignStore::Create(file, from.front().about());
  std::uint64_t end = MergeRows(from, variants, store);
  for (const CampaignStore& shard : from) end = std::max(end, shard.asked());
  store.SetAsked(end);
  WriteFileWhole(out / "scenario.resolved.yaml", SettingsFor(out, scenario, recorded, globals));
  CampaignOptions options;
  options.end = end;
  options.jobs = 0;  // nothing more is driven
  options.gate = CampaignGate::Read(scenario.gate(), end, scenario.drives());
  const CampaignRun run = RunCampaign(scenario, store, options);
  for (std::size_t v = 0; v < variants.size(); ++v)
    if (run.end == CampaignEnd::kMissing && run.variants[v].prefix < end)
      globals.Say(
          fmt::format("{}: no shard holds the episodes {}; those behind the first of them are "
                      "kept and not counted",
                      variants[v].name, Missing(store.Episodes(variants[v].name), end)));
  return SayResults(scenario, store, run, out, globals);
}

}  // namespace

void AddMerge(CommandLine& line, const Globals& globals, int& status) {
  struct Options {
    std::vector<std::string> shards;
    std::string out;
  };
  auto options = std::make_shared<Options>();
  Subcommand command =
      line.Add("merge", "Join shards of one campaign (--episodes A:B), driven anywhere");
  command.Texts("SHARD_DIR", options->shards, "Folders that `campaign` wrote",
                Subcommand::Need::kRequired);
  command.Text("--out", options->out, "Output folder", Subcommand::Need::kRequired);
  command.OnRun(
      [options, &globals, &status] { status = Merge(options->shards, options->out, globals); });
}

}  // namespace floorproof
