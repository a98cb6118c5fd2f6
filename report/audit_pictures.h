// SPDX-License-Identifier: Apache-2.0
// Where an audit samples and how its order was found, as pictures in the style of Figures 3, 8 and
// 11 of "audit-sampling".
#pragma once

#include <filesystem>
#include <string>

#include "planners/planner.h"

namespace floorproof {

// The places, marked by why they were chosen, over the map, with the room's boundary and the tour;
// those that the robot cannot reach are marked apart.
void WriteSamples(const std::string& title, const HazardMap& map, const PlanResult& plan,
                  const std::filesystem::path& png);
// The best length over iterations, of a plan that has some.
void WriteConvergence(const std::string& title, const PlanResult& plan,
                      const std::filesystem::path& png);

}  // namespace floorproof
