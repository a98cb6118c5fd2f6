// SPDX-License-Identifier: Apache-2.0
// A campaign's page, gathered and written.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "base/console.h"

namespace floorproof {

struct WrittenReport {
  std::filesystem::path page;
  std::string verdict;  // in a sentence
  std::size_t bytes = 0;
  std::vector<std::string> linked;  // films that are not in the page
};

// Writes report.html and its pictures into a folder that `campaign` wrote, from what that records
// alone. `named`: the folder as the commands on the page name it. Throws as GatherReport and
// WriteFileWhole do.
WrittenReport WriteCampaignReport(const std::filesystem::path& folder, const std::string& named,
                                  const Console& console);

}  // namespace floorproof
