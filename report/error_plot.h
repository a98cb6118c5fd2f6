// SPDX-License-Identifier: Apache-2.0
// How far a robot was beside its plan, and beside where it thought it was, over time.
#pragma once

#include <filesystem>
#include <string>

#include "run/episode/episode.h"

namespace floorproof {

// Cross-track error of the true pose; and, where the estimate was not the truth, its error and its
// own spread. Throws InputError when the file cannot be written.
void WriteErrorPlot(const std::string& title, const EpisodeRecord& record,
                    const std::filesystem::path& png);

}  // namespace floorproof
