// SPDX-License-Identifier: Apache-2.0
// What a planner may know, as files that any program reads (docs/external-planner.md).
#pragma once

#include <cstdint>
#include <filesystem>

#include "planners/planner.h"
#include "planners/risk/risk_map.h"

namespace floorproof {

// The version of request.json and of what stands beside it.
inline constexpr int kPlanRequestVersion = 1;

// Writes request.json, map.pgm and map.png, reach.pgm and reach.png, and risk.csv. `seed` stands in
// place of the request's own: many languages read numbers of 32 bits exactly, few those of 64. The
// request has its risk. Throws InputError, DiskError.
void WritePlanRequest(const PlanRequest& request, std::uint32_t seed,
                      const std::filesystem::path& folder);

}  // namespace floorproof
