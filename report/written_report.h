// SPDX-License-Identifier: Apache-2.0
// What is said of a page that was written.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace floorproof {

struct WrittenReport {
  std::filesystem::path page;
  std::string verdict;  // in a sentence
  std::size_t bytes = 0;
  std::vector<std::string> linked;  // films that are not in the page
};

}  // namespace floorproof
