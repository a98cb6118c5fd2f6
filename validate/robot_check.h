// SPDX-License-Identifier: Apache-2.0
// What there is to know of a robot before it is trusted: its figures, what is wrong about it and
// how that is mended, and ten seconds of its drive.
#pragma once

#include <string>
#include <vector>

#include "env/scene/robot_stance.h"
#include "validate/robot_drive.h"

namespace floorproof {

struct Finding {
  enum class Kind { kWrong, kNote };
  Kind kind = Kind::kWrong;
  std::string what;
  std::string mend;  // what the user can do
  std::string Line() const;
};

struct RobotCheck {
  RobotSpec spec;
  RobotStance stance;
  RobotDrive drive;
  double track_m = 0;        // between the outermost driven wheels' middles; 0: one behind another
  double top_speed_mps = 0;  // straight on at full voltage, rolling friction taken off
  double top_yaw_radps = 0;  // turning, likewise; 0: not without driving on
  double stall_force_n = 0;  // at the rims of all driven wheels
  std::vector<Finding> findings;  // those of the drive, too
  bool ok() const;                // nothing is wrong
};

// Throws InputError where it cannot be read or its drive cannot have it.
RobotCheck CheckRobot(const std::string& robot, const WrongModel& wrong = {});

}  // namespace floorproof
