// SPDX-License-Identifier: Apache-2.0
// The sites of the study of predictions, as texts of scenarios.
#pragma once

#include <string>
#include <vector>

#include "env/core/robot_spec.h"

namespace floorproof {

// Sites that predictors may be fitted to, and sites that they are judged by: other seeds, another
// mix of hazards.
enum class StudySet { kTraining, kTest };
inline const char* Name(StudySet set) { return set == StudySet::kTraining ? "training" : "test"; }

inline const std::vector<std::string> kStudyPlanners = {"boustrophedon", "spiral", "risk_coverage",
                                                        "fmea_path_transform"};

// A small floor with hazards of sizes drawn from what this robot crosses surely to what it hardly
// does; friction and mass are drawn for each drive. `model`: risk_model.json, absolute.
std::string StudyScenario(const std::string& robot, const RobotSpec& spec, StudySet set, int number,
                          const std::string& planner, const std::string& model);

}  // namespace floorproof
