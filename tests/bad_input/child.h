// SPDX-License-Identifier: Apache-2.0
// Runs a program, or a function in a process of its own, and measures it.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace floorproof {

struct ChildResult {
  int status = -1;     // exit status; -1: ended by a signal
  int signal = 0;      // which
  double cpu_s = 0;    // of all its threads, user and system
  double most_mb = 0;  // largest resident size
  std::string out, err;
};

struct ChildLimits {
  int cpu_s = 60, wall_s = 120;             // it is killed beyond
  std::optional<std::size_t> file_bytes{};  // files cannot grow beyond, as on a full disk
};

// What the process does: argv[0] and the arguments in, an exit status out.
using ChildMain = std::function<int(int argc, char** argv)>;

// Runs `main` in a forked process, in `folder`, with nothing on stdin. It ends as if `main` had
// been the program's, so what a sanitizer looks for at the end is looked for.
ChildResult RunForked(const ChildMain& main, const std::vector<std::string>& arguments,
                      const std::filesystem::path& folder, const ChildLimits& limits = {});

// Runs a program in the same way.
ChildResult RunChild(const std::string& program, const std::vector<std::string>& arguments,
                     const std::filesystem::path& folder, const ChildLimits& limits = {});

}  // namespace floorproof
