// SPDX-License-Identifier: Apache-2.0
// A plan made ready for tracking: cleaned of duplicate points, with stops and passing speeds.
//
// Points that lie on a straight line to within straight_m are dropped (cone test, one pass), so
// that noise and duplicates make no corners. A vertex is a stop where the plan dwells, ends, turns
// by more than corner_rad, or bends at all at a waypoint that stops. The robot drives through the
// other vertices, at a speed that bounds both the cut of the corner and the yaw rate. One backward
// pass makes the speeds reachable with the deceleration. A robot that cannot turn on the spot stops
// at no corner; it drives around a sharp one as on its tightest arc. All of this happens in a
// tracker's Start() and Extend(); following the path allocates nothing. For robots that keep the
// plan's yaw (holonomic ones), a change of yaw is a stop, and a bend driven with held yaw is
// bounded by the acceleration across it instead of the yaw rate. For robots that take the plan's
// shapes (hinged blocks), a change of shape is a stop, too.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "env/core/path.h"

namespace floorproof {

struct ReferenceLimits {
  double straight_m = 0.004;  // points within this of a straight are on it
  double corner_rad = 0.85;   // sharper corners are stops
  double cut_m = 0.02;        // corner cut allowed in a bend
  double yaw_rate_radps = 1;  // allowed in a bend
  double yaw_accel_radps2 = 3;
  double decel_mps2 = 0.4;
  double lag_s = 0.15;       // time constant of the last centimetres before a stop
  double cruise_mps = 0.25;  // of waypoints that state no speed
  double max_speed_mps = 0.5;
  // The tightest arc that the robot can drive: it stops at no corner, and passes them that far off.
  // 0: it turns on the spot.
  double turn_radius_m = 0;
  bool holds_yaw = false;  // the plan's yaw is held; else it is ignored
  bool folds = false;      // the plan's shapes are taken; else they are ignored
  bool faces = false;      // where the plan dwells its yaw is turned to; else it is ignored there
};

struct ReferenceDwell {
  double time_s = 0;
  std::optional<double> face_rad;   // turned to before
  std::vector<WaypointTask> tasks;  // done meanwhile, in the plan's order
};

struct ReferenceVertex {
  Vec2 p_W = Vec2::Zero();
  Vec2 direction_W = Vec2::Zero();  // unit, to the next vertex; at the last: as before
  double s_m = 0;                   // way from the first vertex
  double speed_mps = 0;             // allowed from here to the next vertex
  double passing_mps = 0;           // at most here; 0 at stops
  // Of the waypoints here, one after the other; those that face the same way are one.
  std::vector<ReferenceDwell> dwells;
  bool stop = false;
  std::optional<double> yaw_rad;    // held from here to the next vertex; none: along the way
  std::vector<std::string> shapes;  // taken here, one after the other, before going on
};

struct ReferencePath {
  std::vector<ReferenceVertex> vertices;
  std::vector<double> waypoint_s_m;  // each waypoint's place along the vertices, never decreasing
};

ReferencePath MakeReference(const Path& path, const ReferenceLimits& limits);

// The speed (m/s, or rad/s) from which a robot comes to rest within `way`, if it decelerates at
// `decel` and its wheels are late by lag_s.
double StoppingSpeed(double way, double decel, double lag_s);

// The speed from which a robot that decelerates as `limits` say comes down to `then_mps` over
// `way_m`. Far from the end it is about sqrt(then^2 + 2 a s). Near the end it falls with the
// distance at the rate 1 / lag_s, which a robot whose wheels lag can follow.
double ApproachSpeed(double then_mps, double way_m, const ReferenceLimits& limits);

}  // namespace floorproof
