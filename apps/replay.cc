// SPDX-License-Identifier: Apache-2.0
#include "report/replay.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "base/input_file.h"
#include "run/campaign/replay_shelf.h"
#include "run/episode/records.h"
#include "run/scenario/scenario_file.h"

namespace floorproof {
namespace {

int ReplayOfRun(const std::filesystem::path& folder, bool video, const Globals& globals) {
  for (const char* needed : {"scenario.resolved.yaml", "result.json"})
    if (const std::string why = WhyUnreadable(folder / needed, kMaxResultBytes); !why.empty())
      throw InputError({(folder / needed).string(), 0}, "", "",
                       why + ": not a folder of a finished `run`, nor of a `campaign`");
  globals.Result(ReplayRun(folder, globals.Overrides(), globals.trust(), video, globals));
  return kExitDone;
}

int ReplayOfCampaign(const std::filesystem::path& folder, std::optional<std::uint64_t> episode,
                     const std::string& name, bool video, const Globals& globals) {
  if (!episode)
    throw InputError({"--episode", 0}, "", "",
                     "is needed: " + folder.string() + " holds a campaign");
  if (!globals.sets.empty())
    throw InputError({"--set", 0}, "", globals.sets.front(),
                     "changes what was recorded: not for a campaign's episode");
  const CampaignStore store = CampaignStore::Open(folder / "campaign.sqlite", false);
  const ScenarioFile file(folder / "scenario.resolved.yaml", {}, globals.trust());
  const auto& variants = file.variants();
  const auto variant =
      name.empty() ? variants.begin() : std::ranges::find(variants, name, &Variant::name);
  if (variant == variants.end() || (name.empty() && variants.size() > 1)) {
    std::string known;
    for (const Variant& v : variants) known += (known.empty() ? "" : "; ") + v.name;
    throw InputError({"--variant", 0}, "", name, "must be one of: " + known);
  }
  const auto row = store.Find(variant->name, *episode);
  if (!row)
    throw InputError({"--episode", 0}, "", std::to_string(*episode),
                     "is not among those of " + variant->name);
  const DriveResult result = ReplayEpisode(file, *variant, *row, folder, {.video = video}, globals);
  globals.SayFact("Results", EpisodeFolder(folder, variant->name, *episode).string());
  globals.Result(ResultJson(file.Read(*episode, *variant), result.record));
  return kExitDone;
}

}  // namespace

void AddReplay(CommandLine& line, const Globals& globals, int& status) {
  struct Options {
    std::string folder, variant;
    std::int64_t episode = -1;
    bool video = false;
  };
  auto options = std::make_shared<Options>();
  Subcommand command = line.Add("replay", "Drive a recorded episode again, exactly, and film it");
  command.Text("DIR", options->folder, "A folder that `run` or `campaign` wrote",
               Subcommand::Need::kRequired);
  command.NonNegative("--episode", options->episode, "Of a campaign: the episode's id");
  command.Text("--variant", options->variant, "Of a campaign with a matrix: the variant");
  command.Flag("--video", options->video, "Film it: video.mp4 and frame_*.png");
  command.OnRun([options, &globals, &status] {
    const std::filesystem::path folder = options->folder;
    std::error_code ignored;
    if (!std::filesystem::exists(folder / "campaign.sqlite", ignored)) {
      status = ReplayOfRun(folder, options->video, globals);
      return;
    }
    std::optional<std::uint64_t> episode;
    if (options->episode >= 0) episode = static_cast<std::uint64_t>(options->episode);
    status = ReplayOfCampaign(folder, episode, options->variant, options->video, globals);
  });
}

}  // namespace floorproof
