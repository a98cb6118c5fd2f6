// SPDX-License-Identifier: Apache-2.0
// One episode of a scenario, read and checked: what it says and the world that it is driven in.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/config.h"
#include "base/input_files.h"
#include "run/scenario/scenario_spec.h"
#include "run/scenario/world.h"

namespace floorproof {

// The parts of the text that a resolved scenario repeats as they were written.
struct ScenarioText {
  ConfigNode randomise, matrix, gate;  // null: not there
  ConfigNode site;                     // overrides and draws applied
  std::filesystem::path site_folder;   // that its paths are relative to
};

struct Scenario {
  ScenarioSpec spec;
  World world;
  ScenarioText text;
  InputFiles files;  // what it was read from
};

// The line to print before that program is run (ProgramLine); empty: none is. Throws as
// CheckProgram.
std::string ProgramAnnounced(const Scenario& scenario);

// Of whoever drives again what somebody sent, and must not come to run that somebody's program.
// Throws InputError where one is yet to be asked.
void RefuseProgram(const Scenario& scenario);

// The files it was read from, beside its own: site, map, image, robot, plan.
std::vector<std::filesystem::path> FilesRead(const Scenario& scenario);

// These and its own.
std::vector<std::filesystem::path> InputsOf(const Scenario& scenario);

}  // namespace floorproof
