// SPDX-License-Identifier: Apache-2.0
// The sites of the study of predictions, as texts of scenarios.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "env/core/robot_spec.h"

namespace floorproof {

// Sites that predictors may be fitted to, and sites that they are judged by: other seeds and
// another mix of hazards; or real maps with hazards laid on them. Hard ones have more strips across
// the floor, and harder sizes, short of what no robot crosses however it drives.
enum class StudySet { kTraining, kTest, kMaps, kHard };
inline const char* Name(StudySet set) {
  constexpr const char* kNames[] = {"training", "test", "maps", "hard"};
  return kNames[static_cast<int>(set)];
}

inline const std::vector<std::string> kStudyPlanners = {"boustrophedon", "spiral", "risk_coverage",
                                                        "fmea_path_transform"};

inline const std::vector<std::string> kStudyMaps = {"lab_small", "small_house"};

struct StudyInputs {
  std::string robot, model;  // risk_model.json, absolute
  RobotSpec spec;
  std::filesystem::path maps;  // absolute: a folder a map, with map.yaml
};
// A small floor, or one of the maps in turn, with hazards of sizes drawn from what this robot
// crosses surely to what it hardly does; friction and mass are drawn for each drive. Throws
// InputError where a map cannot be read.
std::string StudyScenario(const StudyInputs& inputs, StudySet set, int number,
                          const std::string& planner);

}  // namespace floorproof
