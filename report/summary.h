// SPDX-License-Identifier: Apache-2.0
// summary.json as a page shows it.
#pragma once

#include <filesystem>

#include "report/page.h"

namespace floorproof {

// Fills campaign, versions, gate and variants with their rates. Throws InputError where the file is
// missing or not a campaign's summary.
void ReadSummary(const std::filesystem::path& file, Report& report);

}  // namespace floorproof
