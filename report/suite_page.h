// SPDX-License-Identifier: Apache-2.0
// The suite's page: one robot, or several side by side. As a campaign's (report/page.h) it needs
// nothing beside it and loads nothing; a film that is too large is linked.
#pragma once

#include <filesystem>
#include <string>

#include "report/suite_files.h"

namespace floorproof {

// `folder`: where the films are that are shown. Throws InputError where one cannot be read.
std::string SuitePage(const SuiteReport& report, const std::filesystem::path& folder);

}  // namespace floorproof
