// SPDX-License-Identifier: Apache-2.0
// The room that a robot audits, as an 8-bit image of its occupancy grid ("audit-sampling",
// section 4).
#pragma once

#include <cstdint>

#include "env/core/coverage.h"
#include "env/core/robot_spec.h"

namespace floorproof {

// Values of the image, those of a ROS map file.
inline constexpr std::uint8_t kFreePixel = 254, kUnknownPixel = 205, kOccupiedPixel = 0;

struct Room {
  GridFrame frame;            // cells of at most 0.05 m, those of the sweep area
  Grid<std::uint8_t> pixels;  // S of the paper: one of the three values a cell
  Grid<std::uint8_t> inside;  // free cells that belong to the room
};

// `area`: where the robot may be, and what it sweeps with its own clear shape; `reach_m`: the
// farthest point of that shape from its centre.
//
// Inside are the free cells near to where the robot may be, connected with these: all that its
// shape passes over, and the corners that it does not reach into. Beams that leave a room through
// windows or past open doors draw fans of free cells on a map, too narrow for the robot; so they
// end at the room's edge. Cells that are free and not inside count as unknown in the image, and
// cells around the inside that are not free count as occupied: the edge of what is known is closed
// by them.
Room MakeRoom(const HazardMap& map, const SweepArea& area, double reach_m);

// Of each cell, the share that the robot's sensor gets to, about. A robot whose clear shape is a
// circle turns its sensor to a place from wherever its middle may be; others hold their yaw, with
// their middle over it.
Grid<float> SensorReach(const SweepArea& area, const RobotSpec& robot);

}  // namespace floorproof
