// SPDX-License-Identifier: Apache-2.0
// The ladder's rows as pictures.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "validate/ladder.h"

namespace floorproof {

// Of one robot: limits over speed, a panel a hazard, colours by direction, strokes and
// shades by friction, rollers as rings.
void WriteCapabilityChart(std::span<const LadderRow> rows, const std::string& robot,
                          const std::filesystem::path& png);
// sweep_ROBOT.png: limits over belly clearance, strokes and shades by mass.
void WriteSweepChart(std::span<const LadderRow> rows, const std::string& robot,
                     const std::filesystem::path& folder);

}  // namespace floorproof
