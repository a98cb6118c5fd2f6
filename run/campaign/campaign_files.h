// SPDX-License-Identifier: Apache-2.0
// What a campaign leaves beside its database.
#pragma once

#include <filesystem>

#include "base/result_folder.h"
#include "run/campaign/campaign.h"
#include "run/campaign/campaign_summary.h"

namespace floorproof {

class ScenarioFile;

// These, the settings and the list of failing episodes.
ResultNames CampaignResults();

// Writes episodes.csv, junit.xml and, last, summary.json of what `run` left in the store; returns
// the summary. Throws as WriteFileWhole does.
CampaignSummary WriteSummaryFiles(const CampaignStore& store, const ScenarioFile& file,
                                  const CampaignRun& run, const std::filesystem::path& folder);

}  // namespace floorproof
