// SPDX-License-Identifier: Apache-2.0
// The parts of a scenario's tree, each read and checked: what scenario_file.cc does once overrides,
// variant and draws are in the tree. Used there only.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "run/scenario/scenario.h"

namespace floorproof {

inline constexpr std::uintmax_t kMaxNamedBytes = 256u << 20;  // readers have narrower bounds

// A bundled file's name in a resolved scenario is the same wherever the program stands.
inline constexpr std::string_view kBundled = "bundled:";

// The FMEA tables that come with the program, by name and file.
inline constexpr std::string_view kBundledTables = "htetro";
std::filesystem::path BundledTables();

// What a value set on the command line is marked with, in place of a file.
inline constexpr std::string_view kSet = "--set ";

// Whether this value of this key is a file's path.
bool NamesFile(const std::string& key_path, const std::string& value);
// All keys that may stand at the top.
const std::vector<std::string>& ScenarioKeys();
// A file that the scenario names and that can be read; throws InputError.
std::filesystem::path NamedFile(const std::filesystem::path& folder, const ConfigNode& node,
                                const std::string& key, const InputFiles& files);
// The keys of `start` and `goal`.
void VisitStart(ParamVisitor& v, Pose2& start, double& yaw_deg);
void VisitGoal(ParamVisitor& v, Vec2& goal);
// Parameters of the episode, of the physics and of the film. Throws InputError.
void ReadTopKeys(const ConfigNode& root, Scenario& s);
// Plan, robot, start, goal, plug-ins; the site is there. Throws InputError.
void ReadParts(const ConfigNode& root, Scenario& s);

}  // namespace floorproof
