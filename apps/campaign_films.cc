// SPDX-License-Identifier: Apache-2.0
#include "apps/campaign_films.h"

#include <fmt/format.h>

#include "env/run/episode_maker.h"

namespace floorproof {

namespace fs = std::filesystem;

fs::path EpisodeFolder(const fs::path& campaign, const Variant& variant, std::uint64_t episode) {
  return campaign / "episodes" / variant.name / std::to_string(episode);
}

DriveResult ReplayEpisode(const ScenarioFile& file, const Variant& variant, const EpisodeRow& row,
                          const fs::path& folder, bool video, const Globals& globals) {
  Scenario scenario = file.Read(row.episode, variant);
  const fs::path into = EpisodeFolder(folder, variant, row.episode);
  DriveResult result = DriveAndFilm(scenario, into, {.video = video}, globals);
  if (result.not_written) std::rethrow_exception(result.not_written);
  const EpisodeRow now = MakeRow(variant.name, scenario, row.plan, result.record);
  for (const auto& [what, same] : {std::pair("outcome", now.outcome == row.outcome),
                                   {"events", now.events == row.events},
                                   {"metrics", now.metrics == row.metrics}})
    if (!same)
      throw InternalError(
          fmt::format("{}: the replay differs from the record in '{}' (recorded "
                      "with another version or on another machine type?)",
                      into.string(), what));
  return result;
}

void FilmFirstFailures(const ScenarioFile& file, const CampaignStore& store, const fs::path& folder,
                       const Globals& globals) {
  for (int m = 0; m < kNumFailureModes; ++m) {
    const std::string mode(Name(static_cast<FailureMode>(m)));
    const Variant* variant = nullptr;
    std::optional<EpisodeRow> first;
    for (const Variant& candidate : file.variants())
      store.ForEach(candidate.name, [&](const EpisodeRow& row) {
        if (!row.counts() || row.events_of[static_cast<std::size_t>(m)] == 0) return;
        if (first && first->episode <= row.episode) return;
        first = row;
        variant = &candidate;
      });
    if (!first) continue;
    const fs::path film = EpisodeFolder(folder, *variant, first->episode) / "video.mp4";
    std::error_code ignored;
    if (fs::exists(film, ignored)) continue;
    globals.Say(
        fmt::format("filming the first {}: episode {} of {}", mode, first->episode, variant->name));
    ReplayEpisode(file, *variant, *first, folder, true, globals);
  }
}

}  // namespace floorproof
