// SPDX-License-Identifier: Apache-2.0
// What failed, in words that need no manual.
#pragma once

#include <string>

#include "env/core/event.h"
#include "env/core/hazard_map.h"

namespace floorproof {

// "'threshold' (step, 15 mm)": id, type, and how high it is or how far down it goes.
std::string HazardPhrase(const Hazard& hazard);
// The same of an id, as Event::hazard has it: of "wall" "a wall"; of one that is not on the map the
// id alone.
std::string ObstaclePhrase(const HazardMap& map, const std::string& id);

// "stood still for 8 s before 'threshold' (step, 15 mm)": the robot is left out. What is judged
// stands beside its limit, both with units and with as many digits as tell them apart.
std::string FailureText(const Event& event, const HazardMap& map);
// The same with its place: "... at x 5.58, y 3.03 m".
std::string FailureSentence(const Event& event, const HazardMap& map);

// "roll over (tipped)"
std::string FailureName(const Event& event);
// "x 5.58, y 3.03 m"
std::string PlaceText(double x_m, double y_m);

}  // namespace floorproof
