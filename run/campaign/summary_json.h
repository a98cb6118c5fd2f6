// SPDX-License-Identifier: Apache-2.0
// summary.json: a campaign's summary written, and read back.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "run/campaign/campaign_summary.h"

namespace floorproof {

// What has no rate, no bound or no spread is null.
nlohmann::ordered_json SummaryJson(const CampaignSummary& summary);

// As SummaryJson wrote it. Throws InputError where the file is missing or not a campaign's summary.
CampaignSummary ReadSummary(const std::filesystem::path& file);

}  // namespace floorproof
