// SPDX-License-Identifier: Apache-2.0
#include "validate/suite/population.h"

#include <fmt/format.h>

#include "base/streams.h"

namespace floorproof {
namespace {

// A hard, even floor is between these in ISO 18646-2. The rest are assumptions: what a tank, a bag
// or a battery adds, how well a robot that knows where it is meets an edge, a tired battery.
constexpr double kLeastFriction = 0.6, kMostFriction = 1.0, kMassShare = 0.1;
constexpr double kAngle_deg = 3, kOffset_m = 0.03, kLeastSpeedShare = 0.8;

}  // namespace

std::string PopulationText() {
  return fmt::format(
      "friction {:.1f} to {:.1f}, mass {:.1f} to {:.1f} of the model's, approach within {} degrees "
      "and {} mm, speed {:.1f} to 1.0 of the cruising speed, each uniform",
      kLeastFriction, kMostFriction, 1 - kMassShare, 1 + kMassShare, kAngle_deg, 1000 * kOffset_m,
      kLeastSpeedShare);
}

SuiteDraw DrawRun(std::uint64_t seed, std::string_view method, int run) {
  const auto uniform = [&](const char* what, double low, double high) {
    return Stream(seed, static_cast<std::uint64_t>(run), fmt::format("suite.{}.{}", method, what))
        .Uniform(low, high);
  };
  constexpr double kAngle_rad = kAngle_deg * kPi / 180;
  return {.friction = uniform("friction", kLeastFriction, kMostFriction),
          .mass_share = uniform("mass", 1 - kMassShare, 1 + kMassShare),
          .angle_rad = uniform("angle", -kAngle_rad, kAngle_rad),
          .offset_m = uniform("offset", -kOffset_m, kOffset_m),
          .speed_share = uniform("speed", kLeastSpeedShare, 1),
          .bearing_rad = uniform("bearing", -kPi, kPi)};
}

}  // namespace floorproof
