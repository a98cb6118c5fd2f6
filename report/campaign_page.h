// SPDX-License-Identifier: Apache-2.0
// What a campaign's folder records, gathered for its page. Nothing is driven again.
#pragma once

#include <filesystem>

#include "base/console.h"
#include "base/result_folder.h"
#include "report/page.h"

namespace floorproof {

// Reads summary.json, campaign.sqlite, scenario.resolved.yaml, films and frames; writes the
// pictures of where failures happened, heatmap_failures_<variant>.png, into the folder. `named`:
// the folder as the commands on the page name it; `out`: the same, of PageResults. Throws
// InputError where a file is missing, damaged, or not of the same episodes as the others.
Report GatherReport(const std::filesystem::path& folder, const std::string& named,
                    ResultFolder& out, const Console& console);

// The page and its pictures.
ResultNames PageResults();

}  // namespace floorproof
