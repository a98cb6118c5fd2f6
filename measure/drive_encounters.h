// SPDX-License-Identifier: Apache-2.0
// `measure`: a robot's encounters with hazards, as a campaign.
#pragma once

#include <string>
#include <vector>

#include "base/text_table.h"
#include "measure/robot_campaign.h"
#include "run/scenario/override.h"

namespace floorproof {

// Throws InputError as CampaignOf.
RobotCampaign EncountersOf(const std::string& robot, const std::vector<Override>& overrides);

// For people, a row a meeting: how many episodes, and the share of them that failed in each mode.
TextTable EncounterTable(const CampaignSummary& summary);

}  // namespace floorproof
