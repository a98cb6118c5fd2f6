// SPDX-License-Identifier: Apache-2.0
#include "report/campaign_films.h"

#include <fmt/format.h>

#include <array>

#include "run/campaign/episode_maker.h"

namespace floorproof {

namespace fs = std::filesystem;

fs::path EpisodeFolder(const fs::path& campaign, const Variant& variant, std::uint64_t episode) {
  return campaign / "episodes" / variant.name / std::to_string(episode);
}

void RefuseReplay(const fs::path& where, std::string_view what) {
  throw InternalError(
      fmt::format("{}: the replay differs from the record in '{}' (recorded with "
                  "another version or on another machine type?)",
                  where.string(), what));
}

DriveResult ReplayEpisode(const ScenarioFile& file, const Variant& variant, const EpisodeRow& row,
                          const fs::path& folder, bool video, const Console& console) {
  Scenario scenario = file.Read(row.episode, variant);
  const fs::path into = EpisodeFolder(folder, variant, row.episode);
  if (row.outcome == "error") console.Say("recorded as an error: " + row.message);
  DriveResult result = DriveAndFilm(scenario, into, {.video = video}, console);
  if (result.not_written) std::rethrow_exception(result.not_written);
  const EpisodeRow now = MakeRow(variant.name, scenario, row.plan, result.record);
  if (row.outcome == "error" && now.outcome != "error")
    throw InternalError(
        fmt::format("{}: recorded as an error ({}), which did not come again; `campaign --resume "
                    "--retry-errors` drives it anew",
                    into.string(), row.message));
  for (const auto& [what, same] : {std::pair("outcome", now.outcome == row.outcome),
                                   {"events", now.events == row.events},
                                   {"metrics", now.metrics == row.metrics}})
    if (!same) RefuseReplay(into, what);
  return result;
}

void FilmFirstFailures(const ScenarioFile& file, const CampaignStore& store, const fs::path& folder,
                       const Console& console) {
  struct First {
    const Variant* variant = nullptr;
    EpisodeRow row;
  };
  std::array<First, kNumFailureModes> firsts;  // by mode
  for (const Variant& variant : file.variants())
    store.ForEach(variant.name, [&](const EpisodeRow& row) {
      if (!row.counts()) return;
      for (std::size_t m = 0; m < firsts.size(); ++m) {
        First& first = firsts[m];
        const bool earlier = first.variant == nullptr || row.episode < first.row.episode;
        if (row.events_of[m] > 0 && earlier) first = {&variant, row};
      }
    });
  for (std::size_t m = 0; m < firsts.size(); ++m) {
    const auto& [variant, row] = firsts[m];
    if (variant == nullptr) continue;
    const fs::path film = EpisodeFolder(folder, *variant, row.episode) / "video.mp4";
    std::error_code ignored;
    if (fs::exists(film, ignored)) continue;
    console.Say(fmt::format("filming the first {}: episode {} of {}",
                            Name(static_cast<FailureMode>(m)), row.episode, variant->name));
    ReplayEpisode(file, *variant, row, folder, true, console);
  }
}

}  // namespace floorproof
