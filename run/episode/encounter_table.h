// SPDX-License-Identifier: Apache-2.0
// Encounters as rows of a table: encounters.csv, and the table `encounter` of a campaign's
// database.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "env/core/encounter.h"

namespace floorproof {

struct EncounterColumn {
  std::string_view name;
  bool is_text = false;  // else a number
};
using EncounterValue = std::variant<std::string, double>;

// hazard, type, passage, size (JSON: a map of names to numbers), the columns of kApproach, t_s,
// x_m, y_m, time_s, way_m, outcome, energy_j, after, sensed.
const std::vector<EncounterColumn>& EncounterColumns();
std::vector<EncounterValue> EncounterValues(const Encounter& encounter);
// The encounter again. Throws InternalError where the values are none's.
Encounter EncounterOf(std::span<const EncounterValue> values);

// A column for each name of a size, `size.NAME`, in the order first met.
std::string EncountersCsv(const std::vector<Encounter>& encounters);

}  // namespace floorproof
