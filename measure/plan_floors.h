// SPDX-License-Identifier: Apache-2.0
// Small floors with hazards of sizes drawn for a robot, over which its plans are driven: what
// single encounters come to in whole plans.
#pragma once

#include <span>
#include <string>

#include "base/streams.h"
#include "env/core/robot_spec.h"

namespace floorproof {

// A character of drawn floors, what it is, and which of its type's spans its first key is drawn
// from: a step's are down and up.
struct DrawnHazard {
  const char* character;
  const char* type;
  std::size_t span;
};
std::span<const DrawnHazard> DrawnHazards();

// How far sizes go from what a robot surely crosses, 0, to what it surely does not, 1: nearer to
// the former, as a plan meets a hazard many times.
inline constexpr double kUsuallyHardest = 0.6;
// "height_m: 0.01, width_m: 0.12".
std::string DrawnKeys(const DrawnHazard& drawn, const RobotSpec& spec, Stream& random,
                      double hardest = kUsuallyHardest);
// "cable_cover: {...}, groove: {...}": of each character.
std::string DrawnSizes(const RobotSpec& spec, Stream& random, double hardest = kUsuallyHardest);

// What friction and mass are: known, drawn for each floor, or its friction alone; or drawn for each
// episode.
enum class FloorConditions { kKnown, kKnownFriction, kDrawn };
// The scenario file: so many floors, each planned by four planners. Those whose conditions are
// drawn are the same floors, as someone predicts them who does not know their conditions. `robot`
// is what it says under the key robot: a name, or a file's path.
std::string PlanFloorsScenario(const std::string& robot, const RobotSpec& spec, int floors,
                               FloorConditions conditions);

}  // namespace floorproof
