// SPDX-License-Identifier: Apache-2.0
// One robot driven straight over one hazard: does it cross?
//
// The project's own tracker drives a straight plan at a held speed over a hazard that it knows,
// with the slow-downs of any plan. That is what users drive, and it corrects the robot when an edge
// turns it aside. All of the project's detectors judge, with their defaults. Crossed means that the
// whole robot lies beyond the hazard and no detector fired on the way. To save time, a robot counts
// as held when for 2 s it makes less than 2 % of the commanded progress; the detector `stuck` says
// the same 10 s later. The robot starts at rest, as near as its acceleration allows. One crossing
// is one sample: at the limit, another start or heading may give another result.
#pragma once

#include <functional>
#include <string>

#include "env/core/hazard_map.h"
#include "env/scene/robot_model.h"
#include "env/scene/scene.h"

namespace floorproof {

// The hazard begins at the world's x = 0, its edge along y; the robot's centre passes the origin.
struct CrossingPlan {
  double travel_rad = 0;  // the way's direction in the world: 0 is square to the edge
  double yaw_rad = 0;     // the body's, held all the way; other than travel_rad: holonomic robots
  double beyond_m = 0;  // along the way from the origin: the body's centre is past the hazard here
  double speed_mps = 0.2;
  double run_up_m = 0.03;  // at speed, before the edge
  double friction = 0.8;   // of floor and hazard
  PhysicsParams physics = {};
  bool early = true;  // decide early that the robot is held; false: wait for the detectors
};

struct CrossingResult {
  bool crossed = false;
  // Else why: a failure's mode, or mode/kind; "no progress"; "time" when none of these came within
  // 10 s and four times what the way takes.
  std::string held_by;
  double t_s = 0;  // simulated
  double s_m = 0;  // along the way from the origin: where the body's centre was at the end
};

// Throws InternalError when the physics diverges.
CrossingResult Cross(const RobotModel& robot, Hazard hazard, const CrossingPlan& plan);

}  // namespace floorproof
