// SPDX-License-Identifier: Apache-2.0
// What physics says of a robot in the figures of a maker's data sheet.
//
// Hazards are met head-on, by the tracker and the detectors of any drive (validate/crossing.h), on
// friction 0.8 unless stated. A limit is the largest size up to which every rung is crossed.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "env/known/estimate.h"

namespace floorproof {

// Creeping: no momentum to speak of. Slopes are driven at this share of the top speed.
inline constexpr double kCreep_mps = 0.1, kSlow = 0.3;

struct Approach {
  double speed_mps = kCreep_mps;
  double friction = 0.8;
  double oblique_deg = 0;
};

struct FoundLimit {
  double size = 0;
  bool above_all = false;  // no rung held it
  std::string held_by;     // what ended the crossing just above the limit (CrossingResult)
};

// Of a hazard of the ladder, in its unit; rungs as far apart as a 25th of the wheel's radius (of
// slopes 3 degrees), up to 2 radii (60 degrees), of thresholds
// to 100 mm.
FoundLimit LimitOf(const std::filesystem::path& mjcf, std::string_view hazard,
                   const Approach& approach);

// Mean electrical power of motors and hotel load at this motion on a flat floor, W.
double DrivingPower(const std::filesystem::path& mjcf, const BodyTwist& twist);

}  // namespace floorproof
