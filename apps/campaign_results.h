// SPDX-License-Identifier: Apache-2.0
// What `campaign` and `merge` leave behind and say.
#pragma once

#include <filesystem>

#include "apps/command.h"
#include "run/campaign/campaign.h"

namespace floorproof {

// Writes summary.json, episodes.csv and junit.xml, says the rates and what the gate says, and
// returns the exit status.
int SayResults(const ScenarioFile& file, const CampaignStore& store, const CampaignRun& run,
               const std::filesystem::path& folder, const Globals& globals);

}  // namespace floorproof
