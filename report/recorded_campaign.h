// SPDX-License-Identifier: Apache-2.0
// A campaign as its folder records it, for pages that are made of it.
#pragma once

#include <filesystem>

#include "run/campaign/campaign_store.h"
#include "run/campaign/campaign_summary.h"

namespace floorproof {

struct RecordedCampaign {
  CampaignSummary summary;
  CampaignStore store;  // to be read
};

// Of summary.json and campaign.sqlite. Throws InputError where one is missing, damaged, or of
// another campaign than the other.
RecordedCampaign ReadRecordedCampaign(const std::filesystem::path& folder);

}  // namespace floorproof
