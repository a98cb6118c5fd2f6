// SPDX-License-Identifier: Apache-2.0
// plan.csv: a waypoint a row, ours and a user's own alike.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "env/core/error.h"
#include "env/core/hazard_map.h"
#include "env/core/path.h"

namespace floorproof {

// Columns x_m, y_m (needed), yaw_rad, shape, speed_mps, dwell_s (each optional, empty cells
// allowed), in any order, named in the first row. Throws InputError naming file, line, column,
// value and rule: text for numbers, unknown columns, no waypoint, a point off the map.
// `check_shape` is asked about each shape that is named; it throws where it refuses one.
using CheckShape = std::function<void(const SourceMark& mark, const std::string& shape)>;
Path ReadPlan(const std::filesystem::path& file, const GridFrame& map,
              const CheckShape& check_shape = {});
std::string PlanCsv(const Path& path);

}  // namespace floorproof
