// SPDX-License-Identifier: Apache-2.0
// The answer of a search for rare failures: rare.json, and the same in words.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "run/rare/rare_search.h"

namespace floorproof {

// Its content; no wall times.
nlohmann::ordered_json RareJson(const RareOutcome& outcome);

// What is said at the end, a line each. `folder`: where the search's files are.
std::vector<std::string> RareLines(const RareOutcome& outcome, const std::filesystem::path& folder);

// "1 in 81,300"
std::string OneIn(double probability);

// key=value of each: what stands behind --set.
std::vector<std::string> Sets(const Drawn& set);

// The command that drives a failure again, to be pasted into a shell.
std::string RunCommand(const LikelyFailure& failure, const std::filesystem::path& folder);

}  // namespace floorproof
