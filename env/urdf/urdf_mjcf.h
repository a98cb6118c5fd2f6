// SPDX-License-Identifier: Apache-2.0
// A URDF into the MJCF of a robot of ours (docs/adding-a-robot.md).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "env/urdf/urdf_robot.h"

namespace floorproof {

struct UrdfMjcf {
  std::string text;                // commented, every guess marked as one
  std::vector<std::string> notes;  // what was mended, left out, held or guessed
  std::vector<std::string> wrong;  // as UrdfRobot's
};

// MuJoCo reads the URDF in a child process first. Throws InputError that names the file, the line
// where that is known, and what is wrong.
UrdfMjcf MjcfOfUrdf(const std::filesystem::path& file, const UrdfAnswers& answers,
                    const ChooseDrive& choose, const InputFiles& files = {});

}  // namespace floorproof
