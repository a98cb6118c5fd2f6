// SPDX-License-Identifier: Apache-2.0
// A first site and scenario for a ROS map, with comments from which a newcomer learns the format.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/input_files.h"
#include "env/core/hazard_map.h"
#include "env/core/robot_spec.h"

namespace floorproof {

struct InitFiles {
  std::string site_yaml, scenario_yaml;  // texts; the scenario names the site as "site.yaml"
  std::vector<std::string> warnings;     // of the map; of floor out of reach
};

// The texts of site.yaml and scenario.yaml for this robot on this map, with paths relative to
// `folder_out`, where the caller writes them. The robot starts in the lower left of the largest
// piece of floor that it can reach. Throws InputError when the map is bad or the robot fits nowhere
// on it.
// `robot_key`: how the scenario names the robot, a path from `folder_out` or a bundled robot's
// name; empty: robot.name. `map_key`: how the site names the map; empty: where it lies.
InitFiles MakeInitFiles(const std::filesystem::path& map_yaml, const RobotSpec& robot,
                        const std::filesystem::path& folder_out, const std::string& robot_key = "",
                        const std::string& map_key = "", const InputFiles& inputs = {});

// Where a robot of this shape may start: in the largest piece of floor that it can reach, towards
// the map's lower left, with 0.10 m to spare if there is such a place, heading along the map's x.
// Throws InputError when it fits nowhere.
Pose2 ChooseStart(const HazardMap& map, const RobotSpec& robot);

}  // namespace floorproof
