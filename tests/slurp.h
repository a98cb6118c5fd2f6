// SPDX-License-Identifier: Apache-2.0
// A file as it lies on the disk, for tests of what a program wrote; empty where there is none.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace floorproof {

inline std::string Slurp(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {(std::istreambuf_iterator<char>(in)), {}};
}

}  // namespace floorproof
