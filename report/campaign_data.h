// SPDX-License-Identifier: Apache-2.0
// What a campaign's page has for its scripts: failing episodes as a table, their replays and films,
// and where they failed.
#pragma once

#include <filesystem>
#include <string>

#include "report/page.h"
#include "run/campaign/campaign_store.h"

namespace floorproof {

// Fills `data` and `replays` of the report, whose summary, maps and films are there. `named`: the
// campaign's folder as commands name it.
void AddCampaignData(const CampaignStore& store, const std::filesystem::path& folder,
                     const std::string& named, Report& report);

}  // namespace floorproof
