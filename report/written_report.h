// SPDX-License-Identifier: Apache-2.0
// A page that was written, and what is said of it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "base/result_folder.h"

namespace floorproof {

struct WrittenReport {
  std::filesystem::path page;
  std::string verdict;  // in a sentence
  std::size_t bytes = 0;
  std::vector<std::string> linked;  // films that are not in the page
};

// Writes a page beside records that stay as they are; `names` has its file's name alone. Throws
// InputError, DiskError.
WrittenReport WritePage(const std::filesystem::path& page, const ResultNames& names,
                        const std::string& verdict, const std::string& html);

}  // namespace floorproof
