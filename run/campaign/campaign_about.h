// SPDX-License-Identifier: Apache-2.0
// What a campaign is, and whether two are the same.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "run/campaign/campaign_store.h"

namespace floorproof {

class ScenarioFile;

// The scenario resolved, with the SHA-256 of the files of all variants and draws, and the versions
// of program and engine. Not in it: how many episodes, which of them, and on how many workers.
// Checks every variant and the draws (ScenarioFile::CheckDraws); throws InputError.
CampaignAbout DescribeCampaign(const ScenarioFile& file);

// Its versions, by name. Throws InternalError where they are damaged.
std::vector<std::pair<std::string, std::string>> VersionsOf(const CampaignAbout& about);

// Whether the folder holds that database. Throws InputError where it does and nobody asks to go on
// with it; `what` it is: "a campaign".
bool HoldsDatabase(const std::filesystem::path& folder, const char* name, const char* what,
                   bool resume);
// The database of what `about` says, made where it is not `there`. Throws as RequireSame and
// CampaignStore do; another's is not so much as opened to be written.
CampaignStore OpenOrCreate(const std::filesystem::path& file, const CampaignAbout& about,
                           bool there);

// Throws InputError naming `where` and the first thing that differs.
void RequireSame(const CampaignAbout& there, const CampaignAbout& now,
                 const std::filesystem::path& where);

}  // namespace floorproof
