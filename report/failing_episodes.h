// SPDX-License-Identifier: Apache-2.0
// Episodes of a campaign that did not succeed: what failed, where, and the command that films it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/console.h"
#include "env/core/event.h"
#include "report/page.h"
#include "run/campaign/campaign_store.h"
#include "run/scenario/matrix.h"

namespace floorproof {

// The first event's mode and kind; the outcome where there is none.
std::string WhatFailed(const EpisodeRow& row, const std::vector<Event>& events);
// `named`: the campaign's folder as the command names it; `variants`: there are several.
ReportEpisode FailingEpisode(const EpisodeRow& row, const std::vector<Event>& events,
                             const std::string& named, bool variants);
// All of them into failing_episodes.csv, and some to the terminal; returns how many.
std::uint64_t ListFailingEpisodes(const CampaignStore& store, const std::vector<Variant>& variants,
                                  const std::filesystem::path& folder, const Console& console);

}  // namespace floorproof
