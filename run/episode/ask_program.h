// SPDX-License-Identifier: Apache-2.0
// A plan from a program that the scenario names (docs/external-planner.md).
#pragma once

#include <string>

#include "planners/planner.h"
#include "run/scenario/plan_command.h"

namespace floorproof {

struct Scenario;
struct ScenarioSpec;

struct ProgramAnswer {
  Path path;            // as the program wrote it; empty: it made none
  std::string failure;  // then why not, in a line that begins with its name
};

// Runs it with the request in a folder of its own, and reads the plan.csv that it leaves there.
// Whatever it does is an answer; that it is not there, or not what it was when the scenario was
// read, is an InputError. Throws Interruption, too.
ProgramAnswer AskProgram(const Scenario& scenario, const PlanCommand& program,
                         const PlanRequest& request);

// The seed in its request: the scenario's own, or, of a program that draws, one for each episode.
std::uint32_t ProgramSeed(const ScenarioSpec& spec, const PlanCommand& program);

}  // namespace floorproof
