// SPDX-License-Identifier: Apache-2.0
// What the runs of a test method are drawn from: the floors, loads and approaches of a robot's
// days. Each run has streams of its own, hashed from (seed, run, method and name), so that all
// sizes and all robots meet the same draws.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "env/geometry/geometry.h"

namespace floorproof {

// One run's draws.
struct SuiteDraw {
  double friction = 0.8;  // of the floor and what lies on it: uniform, 0.6 to 1.0
  double mass_share = 1;  // of the model's mass: uniform, 0.9 to 1.1
  double angle_rad = 0;   // the approach, off what the method asks for: uniform, within 3 degrees
  double offset_m = 0;    // and beside it: uniform, within 30 mm
  double speed_share = 0.9;  // of the cruising speed: uniform, 0.8 to 1.0
  double bearing_rad = 0;    // a direction, where the method needs one: uniform, all round
};

// The same in words, one line each: what every method's runs share.
std::string PopulationText();

SuiteDraw DrawRun(std::uint64_t seed, std::string_view method, int run);

}  // namespace floorproof
