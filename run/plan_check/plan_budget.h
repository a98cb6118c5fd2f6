// SPDX-License-Identifier: Apache-2.0
// What a plan is expected to take: time, energy, battery.
#pragma once

#include <optional>

#include "planners/planner.h"

namespace floorproof {

struct Scenario;

struct PlanBudget {
  double time_s = 0;    // the tracker's own estimate: ways, stops, turns, dwells, folding
  double energy_j = 0;  // at the battery's terminals
  std::optional<double> battery_share = {};  // of its capacity; none: it states none
};

// Energy: the hotel load all the time, and while it moves what the motors draw on level floor at
// the plan's mean speed (SteadyMotorsPower). Nothing that goes wrong is in it: slipping, waiting
// for help, faults, hazards that are driven over. Throws InputError as Tracker::Start
// does.
PlanBudget EstimateBudget(const Scenario& scenario, const PlanResult& plan);

}  // namespace floorproof
