// SPDX-License-Identifier: Apache-2.0
// The ladder's rows of one robot as its model states them (env/scene/measured_names.h).
#pragma once

#include <span>
#include <string>

#include "validate/ladder.h"

namespace floorproof {

// Elements of <custom>, one a line. `rows` are those of RobotCells, all of them; `by` says what
// measured them, `model` is the ModelHash of the robot's files.
std::string MeasuredElements(std::span<const LadderRow> rows, const std::string& by,
                             const std::string& model);

}  // namespace floorproof
