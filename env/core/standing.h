// SPDX-License-Identifier: Apache-2.0
// How a robot stands at a pose: on which floor, and what is in its way.
#pragma once

#include <string>
#include <vector>

#include "env/core/hazard_map.h"
#include "env/core/robot_spec.h"

namespace floorproof {

constexpr double kSameLevel_m = 1e-6;  // floors whose heights differ by no more are one level

// Overlaps smaller than this count as touching: a robot is not placed more exactly by hand.
constexpr double kTouch_m = 0.001;

// Heights over the base floor of the map, m.
struct Standing {
  double floor_m = 0;       // of the level that carries its wheels: the highest under one
  double rests_m = 0;       // of the highest that a wheel rests on: the floor, a slope, terrain
  std::string obstruction;  // the id of what it cannot stand on or in, or "wall"; empty: none
  std::string why;          // in words, then
};

// Of the robot upright at X_WB on this map, as built. It stands on the level that its driven wheels
// touch: the base floor, a raised floor, or the bottom of a pit. It cannot
//  - across the edge of a level change, its wheels on floors of several heights;
//  - with a wheel on terrain that rises over its floor by more than its belly does, or in a groove
//    in which it sinks by more than that;
//  - where its body (between its belly and its top) or a wheel would be within a solid of a hazard
//    or a wall, known or not. The body is the robot's outline at its yaw. What overlaps by less
//    than kTouch_m is beside it.
Standing StandAt(const HazardMap& map, const RobotSpec& robot, const Pose2& X_WB);

// The parts of the robot's outline at X_WB, drawn in by this much, but by at most half of their
// inner radius.
std::vector<Polygon> OutlineAt(const RobotSpec& robot, const Pose2& X_WB, double drawn_in_m);
// A polygon of the robot at X_WB, in the world.
Polygon InWorld(const Pose2& X_WB, Polygon polygon_B);
// Whether it reaches into a wall's cell or beyond the map.
bool TouchesWall(const HazardMap& map, Polygon polygon_W);

// The height of the level at this place: that of the last level change that is built there, else 0.
double LevelAt(const HazardMap& map, const Vec2& p_W);
// The same; on a slope, the slope's there.
struct Ground {
  double height_m = 0;
  Vec2 gradient = Vec2::Zero();  // its rise per metre along the world's x and y
};
Ground GroundAt(const HazardMap& map, const Vec2& p_W);

}  // namespace floorproof
