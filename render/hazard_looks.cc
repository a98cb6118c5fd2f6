// SPDX-License-Identifier: Apache-2.0
#include "render/hazard_looks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/words.h"

namespace floorproof {
namespace {

// By class; chosen to stand out from viridis, inferno and cividis, inside a white casing.
constexpr std::array<Rgb, 4> kHazards = {
    {{112, 60, 170}, {70, 180, 230}, {200, 20, 70}, {150, 104, 10}}};

// The first type of a class has its colour, the next are darker and paler.
Rgb Shade(const Rgb& colour, std::size_t type) {
  return type % 3 == 0   ? colour
         : type % 3 == 1 ? MixColours(colour, {0, 0, 0}, 0.45)
                         : MixColours(colour, {255, 255, 255}, 0.45);
}

}  // namespace

Rgb MixColours(const Rgb& from, const Rgb& to, double share) {
  Rgb mixed;
  for (std::size_t k = 0; k < 3; ++k)
    mixed[k] = static_cast<std::uint8_t>(std::lround(from[k] + share * (to[k] - from[k])));
  return mixed;
}

Rgb HazardClassColour(HazardClass hazard_class) {
  return kHazards[static_cast<std::size_t>(hazard_class)];
}

std::vector<HazardLook> HazardLooks(const HazardMap& map) {
  std::array<std::vector<std::string>, kHazards.size()> types;  // in the order of appearance
  std::vector<HazardLook> looks;
  for (const Hazard& hazard : map.hazards) {
    const auto in_class = static_cast<std::size_t>(hazard.hazard_class);
    std::vector<std::string>& seen = types[in_class];
    const auto at = std::ranges::find(seen, hazard.type);
    const auto type = static_cast<std::size_t>(at - seen.begin());
    if (at == seen.end()) seen.push_back(hazard.type);
    looks.push_back(
        {Shade(kHazards[in_class], type), fmt::format("C{} {}{}", in_class + 1, Words(hazard.type),
                                                      hazard.known ? "" : " (not on the map)")});
  }
  return looks;
}

}  // namespace floorproof
