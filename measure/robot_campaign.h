// SPDX-License-Identifier: Apache-2.0
// A campaign that is made for a robot, and driven in a folder of its own.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "env/scene/robot_model.h"
#include "run/campaign/drive_campaign.h"
#include "run/scenario/scenario_file.h"

namespace floorproof {

struct RobotCampaign {
  std::string label;  // the robot's name, or its file's stem
  std::string text;   // of the scenario, as it can be driven from any folder
  std::vector<Override> overrides;
  ScenarioFile file;
};

// Of a bundled robot's name, or of an MJCF file: `scenario` is given what stands under the key
// robot. It stands as if beside the robot's file as NAME_of_ROBOT.yaml, wherever it is driven, so
// that shards are of one campaign. Throws InputError.
RobotCampaign CampaignOf(
    const std::string& robot, const std::string& name,
    const std::function<std::string(const std::string& robot, const RobotModel& model)>& scenario,
    const std::vector<Override>& overrides);

// As DriveCampaign, with the same errors; leaves scenario.yaml in the folder.
CampaignOutcome DriveRobotCampaign(const RobotCampaign& campaign, const CampaignRequest& request,
                                   const std::filesystem::path& folder, CampaignObserver* observer);

}  // namespace floorproof
