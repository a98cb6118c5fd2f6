// SPDX-License-Identifier: Apache-2.0
// summary.json, episodes.csv and junit.xml: what a campaign's rows amount to.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "run/campaign/campaign_gate.h"
#include "run/campaign/campaign_store.h"
#include "run/scenario/matrix.h"

namespace floorproof {

// How a campaign ended: `unfinished`, why not all episodes asked for were driven, in words (empty:
// they were, or the gate was decided before), and whether it was at one that failed.
struct CampaignEnding {
  std::string unfinished;
  bool failed_fast = false;
};

// The rows of the campaign by variant: outcomes; failures of each mode, kind, hazard and place (a
// square of 0.5 m of the world) with exact intervals (two-sided Clopper-Pearson at 95 %), also per
// km and per 1,000 h (Garwood); metrics. Rates are of the episodes that physics drove; a failure
// without an event, too little covered, has the kind `coverage`.
// `gate`: what the gate says of the prefix of each variant, in the order of `variants`; empty
// without a gate.
// Writes episodes.csv, junit.xml and, last, summary.json into the folder; returns the summary.
nlohmann::ordered_json WriteSummaryFiles(const CampaignStore& store,
                                         const std::vector<Variant>& variants,
                                         const std::vector<GateState>& gate,
                                         const CampaignEnding& ending,
                                         const std::string& scenario_name,
                                         const std::filesystem::path& folder);

}  // namespace floorproof
