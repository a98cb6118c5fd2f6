// SPDX-License-Identifier: Apache-2.0
// The page of whatever a folder holds.
#pragma once

#include <filesystem>
#include <string>

#include "base/console.h"
#include "report/written_report.h"

namespace floorproof {

// Of a drive, a campaign, a measurement (report.html) or a search for rare failures (rare.html),
// from what it recorded alone. `named`: the folder as the page's commands name it. Throws
// InputError where it is none of these, or damaged; DiskError.
WrittenReport WriteFolderReport(const std::filesystem::path& folder, const std::string& named,
                                const Console& console);

}  // namespace floorproof
