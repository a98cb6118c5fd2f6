// SPDX-License-Identifier: Apache-2.0
// The hazards that a plan will meet, and how, before it is driven.
#pragma once

#include <vector>

#include "env/core/encounter.h"
#include "planners/planner.h"

namespace floorproof {

struct Scenario;

// The rows that a drive would leave in which nothing goes wrong (docs/results.md): the scenario's
// tracker leads an IdealRobot along the plan, slowing down where it would, and the same meter looks
// on, until the plan is driven, the time is over or enough is covered. Hazards that the robot is
// not told of are met, too. Starts the tracker; throws InputError as Tracker::Start does. Empty
// where the plan has no path. Takes some microseconds a control period.
std::vector<Encounter> ExpectedEncounters(const Scenario& scenario, const PlanResult& plan);

}  // namespace floorproof
