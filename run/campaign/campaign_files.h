// SPDX-License-Identifier: Apache-2.0
// What a campaign leaves beside its database.
#pragma once

#include <filesystem>
#include <string>

#include "run/campaign/campaign_summary.h"

namespace floorproof {

// How a campaign ended: `unfinished`, why not all episodes asked for were driven, in words (empty:
// they were, or the gate was decided before), and whether it was at one that failed.
struct CampaignEnding {
  std::string unfinished;
  bool failed_fast = false;
};

// Writes episodes.csv, junit.xml and, last, summary.json into the folder; returns the summary.
// `gate` as in Summarise.
CampaignSummary WriteSummaryFiles(const CampaignStore& store, const std::vector<Variant>& variants,
                                  const std::vector<GateState>& gate, const CampaignEnding& ending,
                                  const std::string& scenario_name,
                                  const std::filesystem::path& folder);

}  // namespace floorproof
