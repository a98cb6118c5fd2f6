// SPDX-License-Identifier: Apache-2.0
// The heat maps of an episode: where it went, what it swept, where it failed.
#pragma once

#include <filesystem>
#include <span>

#include "env/core/coverage.h"
#include "env/core/event.h"
#include "env/core/hazard_map.h"
#include "env/core/path.h"

namespace floorproof {

// `passes` as CoverageMeter counts them, on area.frame; `plan` may be null.
void WriteVisitsMap(const HazardMap& map, const SweepArea& area, const Grid<std::uint8_t>& passes,
                    const Path* plan, const std::filesystem::path& png);
void WriteCoverageMap(const HazardMap& map, const SweepArea& area, const Grid<std::uint8_t>& passes,
                      const std::filesystem::path& png);
void WriteFailuresMap(const HazardMap& map, std::span<const Event> events, const Path* plan,
                      const std::filesystem::path& png);

}  // namespace floorproof
