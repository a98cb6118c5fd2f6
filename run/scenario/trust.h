// SPDX-License-Identifier: Apache-2.0
// What an untrusted scenario can make the program do (docs/security.md).
//
// Untrusted, it reads files of its own folder, or of the git working tree that the folder is part
// of, and those that come with the program; it starts no program. What the user typed (`--set`) is
// the user's: that may lie anywhere.
#pragma once

#include <filesystem>

#include "base/config.h"
#include "base/input_files.h"

namespace floorproof {

struct PlanCommand;

enum class Trust {
  kNone,
  kFull,  // --trust, or the text is the program's own
};

// The folder that a file is part of: the nearest one at or above its own that holds `.git`, where
// one owner has both; else its own.
std::filesystem::path ProjectFolder(const std::filesystem::path& file);

// Lets `files` read what the scenario in `file` may name untrusted, and nothing else. One that lies
// in the bundled models is the program's own: nothing is confined.
void ConfineScenario(const std::filesystem::path& file, const InputFiles& files);
// Likewise what the ROS map that the user named may: its image lies in its folder, or in the git
// working tree that the folder is part of.
void ConfineMap(const std::filesystem::path& file, const InputFiles& files);
// Lets `files` read what a value names that the user typed for this key, of a scenario in `folder`:
// the file; of a robot or a site its folder too, where its parts lie.
void AllowTyped(const std::string& key, const ConfigNode& value,
                const std::filesystem::path& folder, const InputFiles& files);

// Throws InputError where a confined scenario names this program and the user did not.
void RefuseUntrusted(const PlanCommand& program, const InputFiles& files);

}  // namespace floorproof
