// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "apps/campaign_results.h"
#include "apps/command.h"
#include "env/core/interrupt.h"
#include "env/run/campaign_about.h"
#include "env/run/campaign_merge.h"
#include "env/run/file_output.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

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
  const ScenarioFile scenario(fs::path(shards.front()) / "scenario.resolved.yaml");
  const std::vector<Variant>& variants = scenario.variants();
  CheckOverlaps(from, shards, variants);

  const HoldInterrupts hold;
  MakeFolder(out);
  CampaignStore store = CampaignStore::Create(file, from.front().about());
  const std::uint64_t end = MergeRows(from, variants, store);
  const Scenario base = scenario.Read(std::nullopt);
  WriteFileWhole(out / "scenario.resolved.yaml", ResolvedScenario(base, out));
  CampaignOptions options;
  options.end = end;
  options.jobs = 0;  // nothing more is driven
  options.gate = CampaignGate::Read(base.gate, end);
  const CampaignRun run = RunCampaign(scenario, store, options);
  for (std::size_t v = 0; v < variants.size(); ++v)
    if (run.end == CampaignEnd::kComplete && run.variants[v].prefix < end)
      globals.Say(
          fmt::format("{}: episode {} is in none of the shards; those behind it are kept "
                      "and not counted",
                      variants[v].name, run.variants[v].prefix));
  return SayResults(scenario, store, run, out, globals);
}

}  // namespace

void AddMerge(CLI::App& app, const Globals& globals, int& status) {
  struct Options {
    std::vector<std::string> shards;
    std::string out;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("merge", "Join shards of one campaign (--episodes A:B), driven anywhere");
  command->add_option("SHARD_DIR", options->shards, "Folders that `campaign` wrote")->required();
  command->add_option("--out", options->out, "Output folder")->required();
  command->callback(
      [options, &globals, &status] { status = Merge(options->shards, options->out, globals); });
}

}  // namespace floorproof
