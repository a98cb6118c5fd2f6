// SPDX-License-Identifier: Apache-2.0
// The campaign that a robot's risk is measured by: single encounters with hazards of every type.
//
// A variant is a type, met over it or beside it; obstacles (C1, C2) beside them alone. Each episode
// lays one crossing (env/map/crossing_site.h) and drives its way, in one line or with turns on it
// (planner `straight`). What it is met with is drawn evenly (low discrepancy): the hazard's sizes,
// the edge's angle, the side that leads, speed, lanes, share of the width, gap, wall, friction,
// clearance, mass, and, where it passes by, how wrong it is about where it is. Ranges are made from
// the robot, so that each goes from what it surely crosses to what it surely does not
// (HazardType::Ranges). After a failure the drive goes on (`on_failure: watch`), so that its
// effect is seen; sensors are carried and steer nothing, so that it is seen what they tell. Not
// varied: faults, battery, other estimators' errors.
#pragma once

#include <string>
#include <vector>

#include "env/core/robot_spec.h"
#include "env/scene/robot_model.h"

namespace floorproof {

// The scenario file. `robot` is what it says under the key robot: a name, or a file's path.
std::string EncounterScenario(const std::string& robot, const RobotSpec& spec,
                              const std::vector<std::string>& sensors);
// What it carries: a lidar where its model says where one is mounted, and cliff sensors.
std::vector<std::string> EncounterSensors(const RobotModel& robot);

}  // namespace floorproof
