// SPDX-License-Identifier: Apache-2.0
// `measure`: a robot's plans over small floors, as a campaign, and what their drives say of its
// rates.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "measure/robot_campaign.h"
#include "planners/risk/carry_over.h"
#include "run/scenario/override.h"

namespace floorproof {

// Of so many floors, each with a friction and a mass of its own. Of the overrides those count that
// are about the robot, and the seed. Throws InputError as CampaignOf.
RobotCampaign PlansOf(const std::string& robot, int floors, const std::vector<Override>& overrides);

// From the plans of such a campaign, `driven`, and what the rates in the folder's risk_model.json,
// which holds nothing learned from plans yet, say of them without knowing each floor's friction and
// mass. Plans that meet what was not measured are left out. Throws InputError where the model
// cannot be read.
CarryOver LearnCarryOver(const std::string& robot, int floors,
                         const std::vector<Override>& overrides, const CampaignSummary& driven,
                         const std::filesystem::path& folder);

}  // namespace floorproof
