// SPDX-License-Identifier: Apache-2.0
// A robot's MJCF as MuJoCo parses it, with the files that it is made of.
//
// MuJoCo crashes on some models, hangs on others, and builds what a line of text asks for by the
// gigabyte. So a file that does not come with the program is first read in a child process, and
// used there as it will be used here; only what the child survives is read by this process.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/input_files.h"
#include "env/scene/engine.h"
#include "env/scene/engine_files.h"

namespace floorproof {

struct ParsedMjcf {
  SpecPtr spec;
  EngineFiles engine_files;
  std::vector<std::pair<std::filesystem::path, std::string>> hashes;  // SHA-256 of each file
  std::vector<std::filesystem::path> absolutes;  // of these: named by an absolute path
};

// The parsed file, kept as long as none of its files has other bytes. `use` is called in the child,
// with what was parsed there. Throws InputError naming the file; what `use` throws, too.
const ParsedMjcf& ReadMjcf(const std::filesystem::path& file, const InputFiles& files,
                           const std::function<void(const ParsedMjcf&)>& use);

}  // namespace floorproof
