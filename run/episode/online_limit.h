// SPDX-License-Identifier: Apache-2.0
// How long a planner of unknown floors may drive where the scenario states no time_limit_s.
#pragma once

namespace floorproof {

inline constexpr double kOnlineLimit_s = 3 * 3600;  // simulated

}  // namespace floorproof
