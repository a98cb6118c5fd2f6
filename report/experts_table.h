// SPDX-License-Identifier: Apache-2.0
// The experts' FMEA tables beside what was counted, of fmea_measured.yaml.
#pragma once

#include <filesystem>
#include <string>

namespace floorproof {

// As HTML. Throws InputError naming file, line and key where the file is missing, damaged, or of
// another robot.
std::string ExpertsTables(const std::filesystem::path& file, const std::string& robot);

}  // namespace floorproof
