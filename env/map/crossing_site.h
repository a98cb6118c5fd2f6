// SPDX-License-Identifier: Apache-2.0
// Sites of one crossing: a floor with one hazard, laid so that a robot that comes along a straight
// way, in direction +x, passes over it or beside it as asked.
//
// The hazard is a strip, straight at its ends: of a type that is placed by a line, as wide as its
// keys say; of one placed by a polygon, `length_m` along the way. Its edge is turned against the
// way by `angle_deg`. Over it: it reaches beyond the robot on both sides, or ends where `share` of
// the robot's width passes over it. Beside it: it ends `gap_m` from where the robot passes. Start
// and goal lie `run_up_m` before the first and `run_out_m` behind the last place where the robot is
// within reach of it (kReach_m): there no meeting with it has begun, and none goes on. Walls are
// far away, but for one that `wall_m` brings near, on the side where the hazard is not. Where a
// part of it ends, the end may be met before the edge is. A type with a direction (a ramp) ends as
// it began: a second one, turned about, follows it. Not done: several hazards, ways that bend.
#pragma once

#include <optional>
#include <string>

#include "base/json_schema.h"
#include "base/params.h"
#include "env/geometry/polygon.h"

namespace floorproof {

// Of the edge's angle: nearer to along the way the hazard is as long, and as wide, as at 70
// degrees.
inline constexpr double kCrossingLeastCos = 0.34;

struct CrossingParams {
  std::string kind = "crossing";
  std::string hazard = "step";
  std::string passage = "over";
  std::string side = "left";  // of the way: where the hazard is that is passed, or lies in part
  double angle_deg = 0;
  double lead_deg = 0;
  double share = 1;
  double gap_m = 0.1;
  double length_m = 0.5;  // a person's step; a mat
  double run_up_m = 0.5, run_out_m = 0.5;
  std::optional<double> wall_m;
  double radius_m = 0.2;  // of the robot
  Polygon outline_m;      // of the robot, in its own frame; empty: a circle of radius_m
  ConfigNode sizes;       // by type, what it measures; directions from the edge's inward normal
  void Visit(ParamVisitor& v);
};

// Reads a site's `generate` of this kind. Throws InputError.
CrossingParams ReadCrossing(const ConfigNode& node);
// Without its key `kind`.
NamedSchema CrossingSchema();
// `generate` with every default stated; reading it gives the same parameters.
ConfigNode WriteCrossing(const CrossingParams& params);
// The keys `grid`, `hazards`, `start` and `goal` of the site. `node` is what the parameters were
// read from: refusals name its lines. Throws InputError.
ConfigNode LayCrossing(const CrossingParams& params, const ConfigNode& node);

}  // namespace floorproof
