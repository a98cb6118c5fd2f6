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
#include "run/episode/episode.h"

namespace floorproof {

// Exit statuses (design: the contract).
inline constexpr int kDone = 0, kNotSuccess = 1, kBadInput = 2, kBroken = 3,
                     kGateUndecided = 4;  // and
// kInterruptedExit (base/interrupt.h)

struct Globals : Console {
  std::vector<std::string> sets;  // --set key.path=value

  // Throws InputError when one has no "=".
  std::vector<Override> Overrides() const;
  // The result, with --json, on stdout.
  void Result(const nlohmann::ordered_json& json_result) const;
};

// Where the results of `run` and `plan` go: --out, or out/PATH in the working directory, where PATH
// is the scenario's file as it is from there (all of its path, where it lies outside), without
// .yaml. No two scenarios share one. Throws InputError where it holds a campaign.
std::filesystem::path OutputFolder(const std::string& out, const std::filesystem::path& scenario);
inline constexpr const char* kOutputHelp =
    "Output folder (default: out/PATH, PATH that of SCENARIO without .yaml)";
// A campaign's: --out, or the folder `campaign` there. Throws InputError where it holds a plan or a
// run.
std::filesystem::path CampaignFolder(const std::string& out, const std::filesystem::path& scenario);
inline constexpr const char* kCampaignHelp =
    "Output folder (default: out/PATH/campaign, PATH that of SCENARIO without .yaml)";

// What the episode's draws put in place of what is written.
void SayDrawn(const Scenario& scenario, const Globals& globals);

// Of this machine; at least 1.
int Cores();

// The exit status of one episode.
int ExitStatus(Outcome outcome);

}  // namespace floorproof
