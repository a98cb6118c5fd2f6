// SPDX-License-Identifier: Apache-2.0
// What the suite leaves in its folder beside films and page.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result_folder.h"
#include "validate/suite/robot_suite.h"

namespace floorproof {

struct SuiteReport {
  SuiteOptions options;
  std::vector<SuiteRequirement> required;
  std::vector<RobotSuite> robots;
  std::size_t asked = 0;  // methods of each robot; fewer are done when it was interrupted
};

// suite.json, suite.csv, runs.csv, junit.xml and report.html.
ResultNames SuiteResults();

// robot,method,verdict,size,unit,or_harder,fails_at,withdrawn,figure,figure_unit,n,failures,
// reliability_lower,missed
std::string SuiteCsv(const SuiteReport& report);
// A row a run, in the order driven: its size, its draws and what came of it.
std::string SuiteRunsCsv(const SuiteReport& report);
// A suite a robot, a case a method; its time is simulated.
std::string SuiteJunit(const SuiteReport& report);
nlohmann::ordered_json SuiteJson(const SuiteReport& report);

// Writes them; the page, too. Throws InputError, DiskError.
void WriteSuiteFiles(const SuiteReport& report, const std::filesystem::path& folder);

// Where a method's film lies, within the suite's folder.
std::filesystem::path FilmFolder(const RobotSuite& robot, std::string_view method);

}  // namespace floorproof
