// SPDX-License-Identifier: Apache-2.0
// Failures of a campaign, filmed.
#pragma once

#include <filesystem>

#include "base/console.h"
#include "run/campaign/campaign_store.h"

namespace floorproof {

class ScenarioFile;

// The first failing episode of each mode, of all variants: drafts of the seconds around the
// failure. A film that is there stays.
void FilmFirstFailures(const ScenarioFile& file, const CampaignStore& store,
                       const std::filesystem::path& folder, const Console& console);

}  // namespace floorproof
