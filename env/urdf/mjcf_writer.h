// SPDX-License-Identifier: Apache-2.0
// The found parts of a robot, written as MJCF.
#pragma once

#include <string>

#include "env/urdf/robot_guesses.h"

namespace floorproof {

std::string WriteMjcf(const UrdfRobot& robot, const RobotGuesses& guesses,
                      const UrdfAnswers& answers, const std::string& source);

}  // namespace floorproof
