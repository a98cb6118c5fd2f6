// SPDX-License-Identifier: Apache-2.0
// How a campaign's episodes ended, as tables for people.
#pragma once

#include "base/text_table.h"
#include "run/campaign/campaign_summary.h"

namespace floorproof {

// A row a variant: outcomes, and how many of the drives failed, with the interval.
TextTable OutcomesTable(const CampaignSummary& summary);
// How drives failed. Of one variant a row a mode, with intervals; of several a row a variant. Empty
// where no drive failed.
TextTable ModesTable(const CampaignSummary& summary);

}  // namespace floorproof
