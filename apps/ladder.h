// SPDX-License-Identifier: Apache-2.0
// `validate --ladder`: runs the ladder, prints what it says, writes tables and pictures.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <vector>

#include "apps/command.h"
#include "validate/ladder.h"

namespace floorproof {

// The rows, with a line that says how far they are.
std::vector<LadderRow> ClimbWithProgress(std::span<const LadderCell> cells, int jobs,
                                         const Globals& globals);
// A line a hazard, of each robot and kind of wheels: the least of its limits, and how it was met
// then. The tables hold all.
void SayLeastLimits(std::span<const LadderRow> rows, const Globals& globals);

// Empties the ladder's tables in `folder` and removes its pictures: what stands there later is this
// run's. Throws InputError when nothing can be written there, before minutes of work are lost.
void ClearLadder(const std::filesystem::path& folder);

// ladder.csv, ladder_oblique.csv, ladder_sweep.csv, capability_ROBOT.png, sweep_ROBOT.png. Under
// HoldInterrupts: when interrupted it writes the rows that are done and returns.
nlohmann::ordered_json RunLadder(const std::filesystem::path& folder, int jobs,
                                 const Globals& globals);

}  // namespace floorproof
