// SPDX-License-Identifier: Apache-2.0
// Runs a program and measures it.
#pragma once

#include <filesystem>
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

// Runs it in `folder`, with nothing on stdin.
ChildResult RunChild(const std::string& program, const std::vector<std::string>& arguments,
                     const std::filesystem::path& folder, const ChildLimits& limits = {});

}  // namespace floorproof
