// SPDX-License-Identifier: Apache-2.0
// `plan: {command: [...]}`: a planner that is any program (docs/external-planner.md). What is
// written of it; run/episode/ask_program.h runs it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/config.h"
#include "base/input_files.h"

namespace floorproof {

struct PlanCommand {
  std::vector<std::string> words;  // the program and its arguments, as written
  std::filesystem::path folder;    // that it works in, the scenario's by default
  double timeout_s = 60;           // by the wall clock
  bool uses_seed = false;          // asked anew for each episode, with a seed of its own
  SourceMark mark;                 // of the command

  // What plans are called that it makes: the file of the first word that names one of its folder
  // (cover.py of `python3 cover.py`), else the program's.
  std::string name;
  // Those of its words that name files of its folder: who changes one has another planner.
  std::vector<std::filesystem::path> files;
};

// The key `plan` with a command in it; paths are relative to `folder`, the scenario's. Throws
// InputError. Whether there is such a program is not asked, and `made`, the plan that it gave once,
// is the caller's: with it nothing is run.
PlanCommand ReadPlanCommand(const ConfigNode& plan, const std::filesystem::path& folder,
                            const InputFiles& files);
ConfigNode PlanCommandSchema();
// The key again, with every default stated and its paths from `folder`; `made` in place of its own.
ConfigNode WritePlanCommand(const PlanCommand& command, const std::filesystem::path& folder,
                            const std::filesystem::path& made);

// The program and its arguments as they would be typed.
std::string Typed(const std::vector<std::string>& words);

// Throws InputError if it is not trusted (run/scenario/trust.h), it is not there, or is not what
// was read of it before.
void CheckProgram(const PlanCommand& command, const InputFiles& files);

// Before it is run: which program, and which file says so.
std::string ProgramLine(const PlanCommand& command);

}  // namespace floorproof
