// SPDX-License-Identifier: Apache-2.0
// report.html of a single drive, from what `run` has left in its folder.
#pragma once

#include <filesystem>
#include <string>

#include "report/written_report.h"

namespace floorproof {

struct RunPage {
  std::string html, verdict;
};

// Whether the folder holds a drive's records, and no campaign's.
bool HoldsRun(const std::filesystem::path& folder);

// The page of the drive that `folder` holds, which commands name `named`. Throws InputError where
// result.json cannot be read or is damaged. What else is missing is left out, and said.
RunPage MakeRunPage(const std::filesystem::path& folder, const std::string& named);

// Writes it as the folder's report.html. Throws as MakeRunPage and WriteFileWhole do.
WrittenReport WriteRunReport(const std::filesystem::path& folder, const std::string& named);

}  // namespace floorproof
