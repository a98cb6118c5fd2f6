// SPDX-License-Identifier: Apache-2.0
// Hostile inputs from a seed: good files, and a command that reads them, with a few things changed
// that break programs: numbers that are none, hostile names and paths, cut and repeated text, other
// files' bytes, links, pipes. The same seed gives the same input.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace floorproof {

struct HostileInput {
  std::vector<std::string> arguments;  // of the program
  std::string what;                    // was changed, for people
};

// The kinds of input: a word each ("scenario", "map", "results", ...).
const std::vector<std::string>& HostileKinds();

// The good files of a kind, which need not be hostile: made once, in `folder`. Results are those of
// a drive there. Throws std::runtime_error if the program cannot make them.
void MakeGoodFiles(const std::string& kind, const std::filesystem::path& folder);

// Spoils a copy of the good files in `folder`. Files that hold kSecret (secret_files.h) may be
// named there, or linked to; they lie in `outside`.
HostileInput Spoil(const std::string& kind, std::uint64_t seed, const std::filesystem::path& folder,
                   const std::filesystem::path& outside);

}  // namespace floorproof
