// SPDX-License-Identifier: Apache-2.0
// plan.csv: a waypoint a row, ours and a user's own alike; and a user's places to visit, a row
// each.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/input_files.h"
#include "env/core/hazard_map.h"
#include "env/core/path.h"

namespace floorproof {

// Columns x_m, y_m (needed), yaw_rad, shape, speed_mps, dwell_s (each optional, empty cells
// allowed), in any order, named in the first row. Throws InputError naming file, line, column,
// value and rule: text for numbers, unknown columns, no waypoint, a point off the map. `lines` gets
// the line of each waypoint.
Path ReadPlan(const std::filesystem::path& file, const GridFrame& map,
              std::vector<int>* lines = nullptr, const InputFiles& files = {});
// What ReadPlan asks of each waypoint, for who takes a plan in another form: finite numbers, on the
// map, no speed or dwell with which a drive has no end. `dwell_s`: of those before; this one's is
// added. Throws InputError at `mark`.
void CheckWaypoint(const Waypoint& waypoint, const GridFrame& map, const SourceMark& mark,
                   double& dwell_s);
std::string PlanCsv(const Path& path);

// Columns x_m, y_m alone. Throws InputError as ReadPlan does, and for two places in one of the
// cells in which plans are made (FineFrame), naming both lines.
std::vector<Vec2> ReadPlaces(const std::filesystem::path& file, const GridFrame& map,
                             const InputFiles& files = {});

}  // namespace floorproof
