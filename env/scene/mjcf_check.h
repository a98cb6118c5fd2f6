// SPDX-License-Identifier: Apache-2.0
// Looks for what MuJoCo's reader would hang or choke on, before it reads a robot's file: pipes and
// devices among the files that it names, and copies or pictures by the billion.
#pragma once

#include <filesystem>

#include "base/input_files.h"

namespace floorproof {

// Throws InputError naming file, line, attribute, value and rule. Follows <include>. Files that are
// named by an absolute path are marked so.
void CheckMjcf(const std::filesystem::path& file, const InputFiles& files);

}  // namespace floorproof
