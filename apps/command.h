// SPDX-License-Identifier: Apache-2.0
// What the commands share: global options, printing. A command is one file here and
// one line in commands.inc.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "env/run/scenario.h"

namespace floorproof {

// Exit statuses (design: the contract).
inline constexpr int kDone = 0, kNotSuccess = 1, kBadInput = 2, kBroken = 3,
                     kGateUndecided = 4;  // and
// kInterruptedExit (env/core/interrupt.h)

struct Globals {
  bool json = false, quiet = false;
  std::vector<std::string> sets;  // --set key.path=value

  // Throws InputError when one has no "=".
  std::vector<Override> Overrides() const;
  // A line for people: on stdout, on stderr with --json, nowhere with --quiet.
  void Say(const std::string& line) const;
  // The result, with --json, on stdout.
  void Result(const nlohmann::ordered_json& json_result) const;
};

// Adds the subcommand to `app`; its callback leaves the exit status in `status`.
using AddCommand = void (*)(CLI::App& app, const Globals& globals, int& status);

// --out, or out/<stem of the scenario's file> in the working directory.
std::filesystem::path OutputFolder(const std::string& out, const Scenario& scenario);

// Says what is read as written but may not be meant, and which files are read that lie neither in
// the scenario's folder nor among the bundled models.
void SayWarnings(const Scenario& scenario, const Globals& globals);

}  // namespace floorproof
