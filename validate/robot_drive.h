// SPDX-License-Identifier: Apache-2.0
// Ten seconds of a robot on a flat floor of friction 0.8, beside what its kinematics says: it
// stands, drives straight on, brakes, turns (on the spot where its drive can), and stops.
//
// What it is asked for stays within its own limits: its cruising speed, its accelerations, its
// yaw rate; each is reached within a second. The way and the turn that are expected are those of
// wheels that roll without slip (Drive::ToTwist) at the speeds commanded.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validate/law.h"

namespace floorproof {

struct RobotDrive {
  std::vector<LawRow> rows;   // `law` is the part and what is compared: "straight/way"
  std::string straight_hint;  // why the way is another, where it is; else empty
  std::string turn_hint;      // the same of the turn
  // Ahead of the middle of its wheels, where a skid-steer turns about its load instead; the row
  // turn/off_the_spot is then left out.
  std::optional<double> turns_about_m;
  double driven_share = 0;  // of its weight, on the driven wheels, as it stands
  double rolling_n = 0;     // what holds it back: the wheels' bearings, and casters that slide
};

// Of a bundled name or a file. Throws InputError as ReadRobot and the drive do, InternalError when
// the physics diverges.
RobotDrive DriveTenSeconds(const std::string& robot, const WrongModel& wrong = {});

}  // namespace floorproof
