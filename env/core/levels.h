// SPDX-License-Identifier: Apache-2.0
// Floors of several levels: which one lies where, and how all of them look from one.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "env/core/hazard_map.h"
#include "env/core/robot_spec.h"

namespace floorproof {

// Where each hazard of the map is still there: its footprint, of a level change but for later level
// changes, and of terrain but for these and later grooves. Pieces narrower than 0.1 mm are left
// out.
std::vector<std::vector<Polygon>> BareFloors(const HazardMap& map);

// What the base floor is called where it is a level change: no hazard of the map.
std::string BaseFloorId(const HazardMap& map);

// The map as a robot has it that stands at X_WB: heights are over the floor that carries its wheels
// (StandAt), which is floor as any other then, and no level change. If that is not the base floor,
// the base floor is a level change: a hazard of the type `floor`, where no wall and no other level
// lies. Level changes come first, cut to their bare floor as terrain is: the order among them says
// nothing any more. From the base floor the map stays as it is.
HazardMap SeenFrom(HazardMap map, const RobotSpec& robot, const Pose2& X_WB);

}  // namespace floorproof
