// SPDX-License-Identifier: Apache-2.0
// The plan that an episode drives.
#pragma once

#include <cstdint>

#include "planners/planner.h"

namespace floorproof {

struct Scenario;
struct ScenarioSpec;

// The plan of the scenario: its planner's, the user's file's, or that of a program, which is run
// for it. Who plans gets what is known. Throws InputError where there is no such program.
PlanResult MakePlan(const Scenario& scenario);

// What the draws of an episode's planner begin with.
std::uint64_t PlanSeed(const ScenarioSpec& spec);

}  // namespace floorproof
