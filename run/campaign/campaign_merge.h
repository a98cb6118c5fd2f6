// SPDX-License-Identifier: Apache-2.0
// Shards of one campaign, joined.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "run/campaign/drive_campaign.h"

namespace floorproof {

// Episodes of a variant that no shard holds. Those behind the first of them are kept and not
// counted.
struct MergeGap {
  std::string variant;
  std::vector<EpisodeRange> missing;
};

struct MergeOutcome : CampaignOutcome {
  std::string paths_note;  // why the settings' paths do not hold from `out`; empty: they do
  std::vector<MergeGap> gaps;
};

// Joins folders of DriveCampaign, at least one, into `out`, as if one campaign had driven all of
// their episodes, and judges the gate; drives nothing. Throws InputError where `out` holds a
// campaign, where the shards (named as given) are of different campaigns, disagree on an episode or
// asked for different numbers of episodes under a fixed gate, and where a file cannot be read or
// written.
MergeOutcome MergeCampaigns(const std::vector<std::string>& shards,
                            const std::filesystem::path& out);

}  // namespace floorproof
