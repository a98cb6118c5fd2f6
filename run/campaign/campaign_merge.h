// SPDX-License-Identifier: Apache-2.0
// Shards of one campaign, joined.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "run/campaign/campaign_store.h"
#include "run/scenario/matrix.h"

namespace floorproof {

// Episodes that stand in two shards must be the same in both. Throws InputError naming the shards
// (`names`, as `shards`), variant, episode and the column that differs.
void CheckOverlaps(std::span<const CampaignStore> shards, std::span<const std::string> names,
                   std::span<const Variant> variants);

// Copies each episode once; returns the number behind the last one.
std::uint64_t MergeRows(std::span<const CampaignStore> shards, std::span<const Variant> variants,
                        CampaignStore& into);

}  // namespace floorproof
