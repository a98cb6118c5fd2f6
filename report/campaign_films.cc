// SPDX-License-Identifier: Apache-2.0
#include "report/campaign_films.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "report/replay.h"
#include "run/campaign/replay_shelf.h"
#include "run/scenario/scenario_file.h"

namespace floorproof {

namespace fs = std::filesystem;

namespace {

struct Filming {
  const Variant* variant = nullptr;
  EpisodeRow row;
  std::vector<FailureMode> modes = {};
};

}  // namespace

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
  std::vector<Filming> filmings;  // an episode may be the first of several modes
  for (std::size_t m = 0; m < firsts.size(); ++m) {
    const auto& first = firsts[m];
    if (first.variant == nullptr) continue;
    const auto same = std::ranges::find_if(filmings, [&](const Filming& f) {
      return f.variant == first.variant && f.row.episode == first.row.episode;
    });
    Filming& filming =
        same != filmings.end() ? *same : filmings.emplace_back(Filming{first.variant, first.row});
    filming.modes.push_back(static_cast<FailureMode>(m));
  }
  std::erase_if(filmings, [&](const Filming& f) {
    std::error_code ignored;
    return fs::exists(EpisodeFolder(folder, f.variant->name, f.row.episode) / "video.mp4", ignored);
  });
  for (std::size_t i = 0; i < filmings.size(); ++i) {
    const auto& [variant, row, modes] = filmings[i];
    std::string names;
    for (const FailureMode mode : modes)
      names += (names.empty() ? "" : ", ") + std::string(Name(mode));
    console.Say(fmt::format("film {} of {}: the first {}, episode {} of {}", i + 1, filmings.size(),
                            names, row.episode, variant->name));
    ReplayEpisode(file, *variant, row, folder, {.video = true, .only_around = modes}, console);
  }
}

}  // namespace floorproof
