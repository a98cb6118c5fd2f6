// SPDX-License-Identifier: Apache-2.0
// What draws may change of a drive without moving a hazard or the plan.
#pragma once

#include <string>
#include <vector>

#include "env/core/encounter.h"
#include "planners/planner.h"

namespace floorproof {

struct Scenario;

struct PlainDraw {
  const char* key;  // of a scenario
  double Approach::*of_meeting;
  double DriveConditions::*of_drive;
};
// nullptr: the key is none of them.
const PlainDraw* FindPlainDraw(const std::string& key);

// Conditions as the scenario's `randomise` may draw them, spread evenly over what it may draw and
// each as likely; where it draws none of these keys the one that there is. They say nothing of what
// this episode drew: every episode of the scenario has the same.
std::vector<DriveConditions> ConditionsOf(const Scenario& scenario);

}  // namespace floorproof
