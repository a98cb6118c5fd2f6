// SPDX-License-Identifier: Apache-2.0
// A campaign's page, gathered and written.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "base/console.h"
#include "report/written_report.h"

namespace floorproof {

// Writes report.html and its pictures into a folder that `campaign` wrote, from what that records
// alone. `named`: the folder as the commands on the page name it. Throws as GatherReport and
// WriteFileWhole do.
WrittenReport WriteCampaignReport(const std::filesystem::path& folder, const std::string& named,
                                  const Console& console);

}  // namespace floorproof
