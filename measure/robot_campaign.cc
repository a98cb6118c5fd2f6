// SPDX-License-Identifier: Apache-2.0
#include "measure/robot_campaign.h"

#include "base/file_output.h"
#include "run/scenario/scenario_file.h"

namespace floorproof {

namespace fs = std::filesystem;

RobotCampaign CampaignOf(
    const std::string& robot, const std::string& name,
    const std::function<std::string(const std::string& robot, const RobotModel& model)>& scenario,
    const std::vector<Override>& overrides) {
  const fs::path model = FindRobotFile(robot, {"ROBOT", 0});
  const bool is_file = model == robot;
  const std::string named = is_file ? fs::absolute(model).lexically_normal().string() : robot;
  const std::string label = is_file ? model.stem().string() : robot;
  const std::string text = scenario(named, ReadRobot(model));
  const fs::path beside = is_file ? fs::path(named).parent_path() : fs::path(".");
  return {label, text, overrides,
          ScenarioFile::FromText(text, beside / (name + "_of_" + label + ".yaml"), overrides)};
}

CampaignOutcome DriveRobotCampaign(const RobotCampaign& campaign, const CampaignRequest& request,
                                   const fs::path& folder, CampaignObserver* observer) {
  CampaignOutcome outcome = DriveCampaign(campaign.file, request, folder, observer);
  WriteFileWhole(folder / "scenario.yaml", campaign.text);
  return outcome;
}

}  // namespace floorproof
