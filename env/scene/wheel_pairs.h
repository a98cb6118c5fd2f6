// SPDX-License-Identifier: Apache-2.0
// How a robot's feet touch the world: each by a pair with each floor and hazard. Walls meet the
// body, and wheels that stick out of it.
//
// The normal force of a pair is that of the tyre, K s + B s', and friction is nearly Coulomb's: it
// stops a slip within 10 ms, or 80 ms where wheels scrub. MuJoCo states softness per
// unit of acceleration. With an impedance d that does not depend on the depth and A the inverse
// mass at the contact it presses with (k s + b s') / ((1 - d) A), so k = (1 - d) A K, b = (1 - d) A
// B. d / ((1 - d) A) counts as a mass that moves with the tread: d = 0.1 keeps it to a ninth of the
// moving mass.
//
// A foot stands where its model draws it: the radius is that under the load at rest, and the pair
// begins to press by the sink at rest above that.
//
// Contacts are found up to two steps ahead at the robot's highest speed (5 to 15 mm). They press
// only where feet touch.
//
// What bounces (hazards with a restitution) keeps its own softness, which is made for that
// (restitution.h).
#pragma once

#include "env/scene/robot_model.h"
#include "env/scene/world_geoms.h"

namespace floorproof {

// How much stiffer friction is than the normal force, MuJoCo's `impratio`: with a tyre's impedance
// alone it would creep under its load.
inline constexpr double kImpratio = 1000;

// A tyre's impedance in MuJoCo: its tread counts as a mass of d / ((1 - d) A).
inline constexpr double kTyreImpedance = 0.1;

// Pairs the robot's feet with what `world` holds.
void PairWheels(const HazardMap& map, const RobotModel& robot, const WorldGeoms& world,
                mjSpec* spec);

// Keeps the tyres as stiff as `built` has them after `model`'s masses changed.
void KeepStiffness(const mjModel* built, mjModel* model);

}  // namespace floorproof
