// SPDX-License-Identifier: Apache-2.0
// The plan that an episode drives.
#pragma once

#include <cstdint>

#include "planners/planner.h"
#include "run/scenario/scenario.h"

namespace floorproof {

// The plan of the scenario: its planner's, or the user's file. The planner gets what is known.
PlanResult MakePlan(const Scenario& scenario);

// What the draws of an episode's planner begin with.
std::uint64_t PlanSeed(const Scenario& scenario);

}  // namespace floorproof
