// SPDX-License-Identifier: Apache-2.0
#include "report/campaign_films.h"

#include <fmt/format.h>

#include <array>

#include "report/replay.h"

namespace floorproof {

namespace fs = std::filesystem;

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
