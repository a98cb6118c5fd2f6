// SPDX-License-Identifier: Apache-2.0
// What the commands share: global options, printing. A command is one file here and one line in
// commands.inc: a function of (CommandLine&, const Globals&, int& status) that adds it to the line;
// the command leaves the exit status in `status` when it runs.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "apps/command_line.h"
#include "base/console.h"
#include "base/exit_status.h"
#include "run/episode/episode.h"
#include "run/scenario/override.h"
#include "run/scenario/trust.h"

namespace floorproof {

struct ScenarioSpec;

struct Globals : Console {
  std::vector<std::string> sets;  // --set key.path=value
  bool trusted = false;           // --trust

  // Throws InputError when one has no "=".
  std::vector<Override> Overrides() const;
  Trust trust() const { return trusted ? Trust::kFull : Trust::kNone; }
  // The result, with --json, on stdout.
  void Result(const nlohmann::ordered_json& json_result) const;
};

// Where the results of `run` and `plan` go: --out, or out/NAME in the working directory. NAME is
// the stem of the scenario's file; where that is just `scenario`, as `init` calls all of them, its
// name. Where a campaign lies there, it is the folder `run` in it; with --out it is refused
// (InputError).
std::filesystem::path OutputFolder(const std::string& out, const std::filesystem::path& scenario,
                                   const std::string& name);
inline constexpr const char* kOutputHelp =
    "Output folder (default: out/NAME, NAME that of SCENARIO's file without .yaml)";
// A campaign's, likewise: the folder `campaign` there, where a plan or a run lies.
std::filesystem::path CampaignFolder(const std::string& out, const std::filesystem::path& scenario,
                                     const std::string& name);

// What the episode's draws put in place of what is written.
void SayDrawn(const ScenarioSpec& spec, const Globals& globals);

// The exit status of one episode.
int ExitStatus(Outcome outcome);

}  // namespace floorproof
