// SPDX-License-Identifier: Apache-2.0
// episodes.csv: a campaign's rows as a table.
#pragma once

#include <string>
#include <vector>

#include "run/campaign/campaign_store.h"
#include "run/scenario/matrix.h"

namespace floorproof {

// By variant and episode: outcome, events by mode, metrics, then plan.*, drawn.* and timeout.*
// columns as far as any row has them.
std::string EpisodesCsv(const CampaignStore& store, const std::vector<Variant>& variants);

}  // namespace floorproof
