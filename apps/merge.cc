// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "apps/command.h"
#include "report/campaign_words.h"
#include "run/campaign/campaign_merge.h"
#include "run/campaign/summary_json.h"

namespace floorproof {
namespace {

// "60:70, 80:81", half-open.
std::string Text(const std::vector<EpisodeRange>& missing) {
  std::string text;
  for (const auto& [begin, end] : missing)
    text += fmt::format("{}{}:{}", text.empty() ? "" : ", ", begin, end);
  return text;
}

int Merge(const std::vector<std::string>& shards, const std::filesystem::path& out,
          const Globals& globals) {
  const MergeOutcome outcome = MergeCampaigns(shards, out);
  if (!outcome.paths_note.empty()) globals.Say(outcome.paths_note);
  for (const MergeGap& gap : outcome.gaps)
    globals.Say(
        fmt::format("{}: no shard holds the episodes {}; those behind the first of them are "
                    "kept and not counted",
                    gap.variant, Text(gap.missing)));
  globals.Result(SummaryJson(outcome.summary));
  SayCampaign(outcome, out, globals);
  SayQuietErrors(outcome.summary, globals);
  return CampaignExitStatus(outcome);
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
