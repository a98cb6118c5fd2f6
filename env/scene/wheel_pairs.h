// SPDX-License-Identifier: Apache-2.0
// What of a robot touches the world by pairs of its own.
#pragma once

#include "env/scene/robot_model.h"
#include "env/scene/world_geoms.h"

namespace floorproof {

// Mecanum wheels touch floor and hazards by pairs, through their collider (mecanum_wheel.h), tyres
// that scrub by softer ones (tyre.h), and plain wheels and casters where something holds them back
// as they roll (rolling_drag.h). Walls meet the body.
void PairWheels(const HazardMap& map, const RobotModel& robot, const WorldGeoms& world,
                mjSpec* spec);

}  // namespace floorproof
