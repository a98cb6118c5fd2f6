// SPDX-License-Identifier: Apache-2.0
// Tyres of wheels that scrub: plain driven wheels that do not share an axle slide across the floor
// whenever the robot turns.
//
// MuJoCo's friction is associated: what slides at v is pressed off the floor until it hovers mu b v
// / k above where it would rest, b the damping of the contact's friction and k the stiffness of its
// normal. A contact as hard as the floor's is lost there, found again some milliseconds later, and
// so on: the wheel hops by hundredths of a millimetre, turns faster while it is off the floor, and
// the robot turns by up to a tenth less than its wheels say, its motors drawing current in pulses.
// Rubber gives by more than that. So these wheels touch by pairs whose normal is softer (0.4 mm
// under 64 N) and whose friction is slower, and they slide without a hop up to 0.4 m/s. The price
// is that of a tyre: under a force along the floor it creeps, by 5 mm/s up a slope of 10 degrees.
#pragma once

#include <mujoco/mujoco.h>

#include <vector>

#include "env/core/robot_spec.h"

namespace floorproof {

// The colliding cylinders of the driven wheels, where these are plain and stand on several axles
// that turn alike; none else. `spec` is the robot's MJCF, `robot` was read from it.
std::vector<mjsGeom*> ScrubbingTyres(mjSpec* spec, const RobotSpec& robot);

// Makes the tyre touch `other`, with its friction and rolling drag (rolling_drag.h), by a pair;
// both geoms need names. What bounces (damping ratio below 1) keeps its own softness.
void PairTyre(mjSpec* spec, const mjsGeom* tyre, const mjsGeom* other, double drag);

}  // namespace floorproof
