// SPDX-License-Identifier: Apache-2.0
// What leads a scenario's robot: its plan, or its planner of unknown floors.
#pragma once

#include <memory>

#include "controllers/navigator.h"
#include "planners/planner.h"
#include "run/scenario/scenario_spec.h"

namespace floorproof {

struct ScenarioSpec;
struct World;

// All outlive it. `online`: of an unknown floor, else nullptr. `plan` was made on `known`; of an
// unknown floor it is empty.
std::unique_ptr<Navigator> MakeNavigator(const ScenarioSpec& spec, const World& world,
                                         OnlinePlanner* online, const PlanResult& plan,
                                         const HazardMap& known);

}  // namespace floorproof
