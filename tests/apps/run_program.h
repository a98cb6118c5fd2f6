// SPDX-License-Identifier: Apache-2.0
// The program, run by a shell in a folder until it ends.
#pragma once

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <string>

#include "tests/places.h"
#include "tests/slurp.h"

namespace floorproof {

struct Result {
  int status = -1;
  std::string out, err;
};

inline Result RunProgram(const std::filesystem::path& folder, const std::string& arguments) {
  const std::string err = (folder / ".stderr").string();
  const std::string command = "cd '" + folder.string() + "' && '" + ProgramFile().string() + "' " +
                              arguments + " 2>'" + err + "'";
  Result result;
  std::FILE* pipe = popen(command.c_str(), "r");
  std::array<char, 4096> buffer;
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe))
    result.out.append(buffer.data(), n);
  const int code = pclose(pipe);
  result.status = WIFEXITED(code) ? WEXITSTATUS(code) : -1;
  result.err = Slurp(err);
  return result;
}

}  // namespace floorproof
