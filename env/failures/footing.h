// SPDX-License-Identifier: Apache-2.0
// On which floor a robot stands, and what is a gap from there.
#pragma once

#include "env/core/blocks.h"
#include "env/core/hazard_map.h"
#include "env/core/motion.h"
#include "env/core/robot_spec.h"

namespace floorproof {

// The driven wheels' centres in the body frame, m, wherever the hinges have swung the blocks that
// carry them. Allocates nothing.
class WheelCentres {
 public:
  WheelCentres(const RobotSpec& robot, const Sample& sample);
  Vec3 Of(const WheelSpec& wheel) const;

 private:
  bool swung_;
  BlockMotions start_, now_;  // of the shape that the model states, and of the sample's
};

// Height of the level under the driven wheels over the base floor, m: the highest, as in StandAt.
double FloorUnder(const HazardMap& map, const RobotSpec& robot, const Sample& sample);

// Whether a robot whose floor is at this height, m, goes down into the hazard: a groove, or a level
// below. What is a gap for a robot on the base floor is so for one on any other.
bool IsGap(const Hazard& hazard, double floor_m);

// Whether the hazard is the level at this height, m: for whoever stands there, a floor like any.
bool IsFloor(const Hazard& hazard, double floor_m);

}  // namespace floorproof
