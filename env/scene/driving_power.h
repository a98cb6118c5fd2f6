// SPDX-License-Identifier: Apache-2.0
// What a robot's motors draw on level floor, from its model, in closed form.
#pragma once

#include <mujoco/mujoco.h>

#include "env/core/robot_spec.h"

namespace floorproof {

// What casters and other wheels that no motor drives hold the robot back by at this speed on level
// floor, N. What rolls, on a hinge that is not upright or a ball: by its bearing's dry friction and
// damping. What cannot roll slides, with its own friction (docs/adding-a-robot.md) times its load
// (loads.h).
double CasterDrag(const mjModel* model, const RobotSpec& robot, double speed_mps);

// Electrical power of all driven wheels' motors while the robot drives steadily at this speed, W,
// the hotel load aside: each turns at v / r against its joint's friction and damping and its share
// of the casters' drag, and draws T omega + R (T / K)^2 (MotorPower).
// The law `energy` of `validate` compares the same formula with the simulation. Not in it:
// gathering speed, turns, slopes.
double SteadyMotorsPower(const mjModel* model, const RobotSpec& robot, double speed_mps);

}  // namespace floorproof
