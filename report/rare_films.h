// SPDX-License-Identifier: Apache-2.0
// The likeliest failures that a search found, driven again and filmed.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/console.h"
#include "run/rare/rare_search.h"

namespace floorproof {

class ScenarioFile;

// Where that of the n-th region, from 1, is written.
std::filesystem::path LikelyFailureFolder(const std::filesystem::path& search, std::size_t number);

// Its film, where one lies there of the drive that these make (`key=value`, as behind --set);
// empty: there is none, or of another search. Throws InputError where a folder on the way is a
// link.
std::filesystem::path FilmOf(const std::filesystem::path& search, std::size_t number,
                             const std::vector<std::string>& sets);

// Each region's likeliest failure, whole as `run` would write it, its film a draft of the seconds
// around the failure. A film of it that is there stays. Throws InternalError where one comes out
// other than it was found or cannot be written, and Interruption.
void FilmLikelyFailures(const ScenarioFile& file, const RareOutcome& outcome,
                        const std::filesystem::path& folder, const Console& console);

}  // namespace floorproof
