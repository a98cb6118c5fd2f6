// SPDX-License-Identifier: Apache-2.0
// A scenario written out with every default stated, so that it survives a change of defaults.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace floorproof {

struct Scenario;

// The scenario with every default stated, the site in it, paths valid from `folder` and the SHA-256
// of each file read and of each of `more`. Reading it gives the same scenario; resolving it again
// gives the same text. `made`: the plan that its program has made, so that whoever reads it gets
// that plan and runs nothing.
std::string ResolvedScenario(const Scenario& scenario, const std::filesystem::path& folder,
                             const std::vector<std::filesystem::path>& more = {},
                             const std::filesystem::path& made = {});

// Writes scenario.resolved.yaml into the folder, and beside it copies of the files that it names,
// so that the folder may be moved: reading takes the copies (base/input_files.h). Throws
// InputError.
void WriteResolvedScenario(const Scenario& scenario, const std::filesystem::path& folder,
                           const std::vector<std::filesystem::path>& more = {},
                           const std::filesystem::path& made = {});

}  // namespace floorproof
