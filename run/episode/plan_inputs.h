// SPDX-License-Identifier: Apache-2.0
// Whether two episodes have the same plan.
#pragma once

#include <string>

namespace floorproof {

struct Scenario;

// All that MakePlan reads, as text: the same text, the same plan. The floor's friction is not a
// planner's to know, unless the robot was measured on several: its limits hang on it. Whether they
// are used hangs on more than its keys here say (the battery's voltage).
std::string PlanInputs(const Scenario& scenario);

}  // namespace floorproof
