// SPDX-License-Identifier: Apache-2.0
// A method's film: one of its runs, driven again.
#pragma once

#include <filesystem>

#include "report/suite_files.h"

namespace floorproof {

// Writes the run that the result shows into FilmFolder, as a scenario with its plan, drives it
// there as `run` would, and films it. Throws InternalError when it does not end as it did: a film
// must show what was judged.
void FilmMethod(const RobotSuite& robot, const RobotModel& model, const MethodResult& result,
                const SuiteOptions& options, const std::filesystem::path& folder);

}  // namespace floorproof
