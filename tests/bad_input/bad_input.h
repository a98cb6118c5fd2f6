// SPDX-License-Identifier: Apache-2.0
// Broken files and command lines, as tables. A case begins with files that are good
// (good_files.cc), breaks some, and says what the program's one line must name.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace floorproof {

using Files = std::map<std::string, std::string>;  // name: content

struct BadInput {
  std::string name;  // of the test; letters and digits
  std::vector<std::string> arguments;
  Files files;                     // written over the good ones
  std::vector<std::string> named;  // must stand in the line, in this order
  // Makes what is no plain file (a pipe, a loop of links); false where that cannot be had.
  std::function<bool(const std::filesystem::path& folder)> prepare{};
};
inline void PrintTo(const BadInput& c, std::ostream* out) { *out << c.name; }

// A scenario with its site, the site's map and image, a plan and a robot, all good.
const Files& GoodFiles();
// `text` with the first `from` replaced by `to`; `from` must be there.
std::string Replaced(const std::string& text, const std::string& from, const std::string& to);
// The same case of a user who trusts the scenario: it may name any file.
BadInput Trusted(BadInput c);
// A PNG, BMP or PGM of 8 x 6 grey pixels, all free floor but for a wall around.
std::string GoodPng();
// The same but for the size in its header.
std::string PngOfSize(int width, int height);
std::string GoodBmp();
std::string GoodPgm();

std::vector<BadInput> YamlCases();
std::vector<BadInput> ScenarioCases();
std::vector<BadInput> SensingCases();
std::vector<BadInput> SiteCases();
std::vector<BadInput> MapCases();
std::vector<BadInput> PlanCases();
std::vector<BadInput> RobotCases();
std::vector<BadInput> CommandCases();
std::vector<BadInput> RecordCases();
std::vector<BadInput> InputLimitCases();

}  // namespace floorproof
