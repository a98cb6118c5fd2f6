// SPDX-License-Identifier: Apache-2.0
// Recorded episodes of a campaign, driven again and filmed.
#pragma once

#include <filesystem>
#include <optional>

#include "report/drive_and_film.h"
#include "run/campaign/campaign_store.h"

namespace floorproof {

// Where a campaign's episode is written when it is driven again.
std::filesystem::path EpisodeFolder(const std::filesystem::path& campaign, const Variant& variant,
                                    std::uint64_t episode);

// Throws InternalError: the replay is not what was recorded, `what` of it differs.
[[noreturn]] void RefuseReplay(const std::filesystem::path& where, std::string_view what);

// Drives the recorded episode again into <folder>/episodes/<variant>/<id>, whole as `run` would.
// Throws InternalError when outcome, events or metrics are not the recorded ones.
DriveResult ReplayEpisode(const ScenarioFile& file, const Variant& variant, const EpisodeRow& row,
                          const std::filesystem::path& folder, bool video, const Console& console);

// The first failing episode of each mode, of all variants; a film that is there stays.
void FilmFirstFailures(const ScenarioFile& file, const CampaignStore& store,
                       const std::filesystem::path& folder, const Console& console);

}  // namespace floorproof
