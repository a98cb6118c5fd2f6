// SPDX-License-Identifier: Apache-2.0
// `measure`: a robot's encounters with hazards, driven as a campaign in its folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "run/campaign/drive_campaign.h"

namespace floorproof {

struct EncounterCampaign {
  std::string label;  // the robot's name, or its file's stem
  std::string text;   // of the scenario, as it can be driven from any folder
  ScenarioFile file;
};

// Of a bundled robot's name, or of an MJCF file. It stands as if beside the robot's file, wherever
// it is driven, so that shards are of one campaign. Throws InputError.
EncounterCampaign EncountersOf(const std::string& robot, const std::vector<Override>& overrides);

// Drives them as DriveCampaign does, with the same errors, and leaves scenario.yaml in the folder.
CampaignOutcome DriveEncounters(const EncounterCampaign& campaign, const CampaignRequest& request,
                                const std::filesystem::path& folder, CampaignObserver* observer);

// For people, a row a meeting: how many episodes, and the share of them that failed in each mode.
std::string EncounterTable(const CampaignSummary& summary);

}  // namespace floorproof
