// SPDX-License-Identifier: Apache-2.0
// What `campaign` and `merge` say, and their exit status.
#pragma once

#include <filesystem>

#include "apps/command.h"
#include "run/campaign/drive_campaign.h"

namespace floorproof {

// Says the rates, the failing episodes (all of them into failing_episodes.csv) and what the gate
// says.
void SayResults(const CampaignOutcome& outcome, const std::filesystem::path& folder,
                const Globals& globals);

// Errors first, then an early end at a failure, then the gate.
int ExitStatus(const CampaignOutcome& outcome);

}  // namespace floorproof
