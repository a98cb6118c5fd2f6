// SPDX-License-Identifier: Apache-2.0
// What the ladder leaves in its folder, and its rows as JSON.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string_view>

#include "validate/ladder.h"

namespace floorproof {

// Whether the ladder writes a file of this name.
bool IsLadderFile(std::string_view name);

// Empties ladder.csv, ladder_oblique.csv and ladder_sweep.csv and removes the charts: what an
// earlier climb left does not stand for this one. Throws InputError where a table cannot be
// written.
void ClearLadder(const std::filesystem::path& folder);

// Both charts of each robot (capability_chart.h), of the ladder's rows and its sweep's.
void WriteLadderCharts(std::span<const LadderRow> rows, std::span<const LadderRow> sweep,
                       const std::filesystem::path& folder);

// A list of objects; clearance_m and mass_kg stand in those of the sweep.
nlohmann::ordered_json LadderJson(std::span<const LadderRow> rows);

}  // namespace floorproof
