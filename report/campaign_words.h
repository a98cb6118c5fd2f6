// SPDX-License-Identifier: Apache-2.0
// What is said of a campaign that ended, and the exit status of who drove or merged it.
#pragma once

#include <filesystem>
#include <string>

#include "base/console.h"
#include "run/campaign/drive_campaign.h"

namespace floorproof {

// Says the outcomes and rates, what they depend on (all of it into dependence.csv), some of the
// failing episodes (all of them into failing_episodes.csv), what the gate says, and where the files
// are. `page_follows`: the page is written next, and nobody needs to be told how.
void SayCampaign(const CampaignOutcome& outcome, const std::filesystem::path& folder,
                 const Console& console, bool page_follows = false);

// "18 of 40 episodes ended in an error, the first: episode 3: ..."; empty: none did.
std::string ErrorsText(const CampaignSummary& summary);

// That, on stderr, where a quiet console would leave the exit status unexplained.
void SayQuietErrors(const CampaignSummary& summary, const Console& console);

// Errors first, then an early end at a failure, then the gate.
int CampaignExitStatus(const CampaignOutcome& outcome);

}  // namespace floorproof
