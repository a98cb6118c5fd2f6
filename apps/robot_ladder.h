// SPDX-License-Identifier: Apache-2.0
// `robot --ladder`: measures what one robot crosses, and writes that into its model.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "apps/command.h"
#include "env/scene/robot_model.h"

namespace floorproof {

inline constexpr const char* kLadderTable = ".ladder.csv";
inline constexpr const char* kLadderChart = ".ladder.png";

// Finds the limits of RobotCells, on so many threads; writes `pictures` with these two endings, and
// last the limits into `target` (PlaceForLimits). Throws Interruption with the table of what was
// found written and the model untouched, and InputError where the model's files are no longer what
// was measured. Returns its rows.
nlohmann::ordered_json MeasureLimits(const RobotModel& robot, const std::filesystem::path& target,
                                     const std::filesystem::path& pictures, int jobs,
                                     const Globals& globals);

}  // namespace floorproof
