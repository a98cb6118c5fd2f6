// SPDX-License-Identifier: Apache-2.0
// Which groups of links are wheels on the floor, which of them are driven, and where the robot's
// frame B then lies.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "env/urdf/link_groups.h"
#include "env/urdf/round_fit.h"
#include "env/urdf/urdf_robot.h"

namespace floorproof {

// A group that rolls on a level axle, and reaches the floor.
struct Roller {
  std::size_t group = 0;
  RoundFit fit;          // in M
  bool swivels = false;  // its group hangs on one that turns about the vertical
  double low_m = 0;      // its lowest point in M
};

struct FoundWheels {
  std::vector<Roller> rollers;
  std::vector<std::size_t> driven;  // indices of rollers
  DriveChoice drive;
  // Of B in M: forward is square to the driven wheels' axle, as near to M's x as it goes.
  Mat3 R_MB = Mat3::Identity();
  Vec3 p_MB = Vec3::Zero();
};

// All that roll are driven where a drive takes them; else the largest pair that one takes, which a
// note says. Throws InputError where there are none.
FoundWheels FindWheels(const std::filesystem::path& file, const UrdfModel& model,
                       const std::vector<LinkGroup>& groups, const UrdfAnswers& answers,
                       const ChooseDrive& choose, std::vector<std::string>& notes);

// From a Mecanum wheel's axle, to the left, to the axes of the rollers that touch the floor, seen
// from above, with the wheel at p_B: those of four wheels meet in the middle, drawn on.
double RollerAngle(const Vec3& p_B);

// A gap to the floor that a draughtsman leaves under a wheel of this radius, m.
double FloorGap(double radius_m);

}  // namespace floorproof
