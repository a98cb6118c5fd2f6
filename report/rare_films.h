// SPDX-License-Identifier: Apache-2.0
// The likeliest failures that a search found, driven again and filmed.
#pragma once

#include <filesystem>

#include "base/console.h"
#include "run/rare/rare_search.h"

namespace floorproof {

// Where the n-th of them, from 1, is written.
std::filesystem::path LikelyFailureFolder(const std::filesystem::path& search, std::size_t number);

// Each region's likeliest failure, whole as `run` would write it, its film a draft of the seconds
// around the failure. A film that is there stays. Throws InternalError where one comes out other
// than it was found.
void FilmLikelyFailures(const ScenarioFile& file, const RareOutcome& outcome,
                        const std::filesystem::path& folder, const Console& console);

}  // namespace floorproof
