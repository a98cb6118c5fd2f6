// SPDX-License-Identifier: Apache-2.0
// How near a plan leads the robot to what it must not touch, before anything is driven.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planners/planner.h"

namespace floorproof {

struct World;

// A place where the plan leads the robot into something.
struct PlanConflict {
  std::string obstacle;              // the id of the hazard; "wall" for the map's own
  Vec2 p_W = Vec2::Zero();           // of the robot's centre, where it overlaps most
  double along_m = 0;                // its way along the plan to there
  double overlap_m = 0;              // the side of the robot would have to be that much farther in
  double over_m = 0;                 // length of the path on which it overlaps, all times together
  int times = 1;                     // the plan comes to this place
  double width_m = 0;                // of the robot, across its way there
  std::optional<double> gap_m = {};  // that the way leads through; none: it is wider than the robot
  std::string other_side = {};  // of the gap: `obstacle` stands on the one side, this on the other
};

// A known level change that the plan leads over and that is beyond the robot's `step_m`, or any
// known hazard that is beyond its measured limits.
struct PlanCrossing {
  std::string hazard;       // its id
  double height_m = 0;      // its floor over the base floor; negative: below
  Vec2 p_W = Vec2::Zero();  // where the robot's centre first comes to its edge
  double along_m = 0;       // the way along the plan to there
  int times = 1;            // the plan comes to it
};

struct PlanClearance {
  // Between the robot and the nearest obstacle on the whole way, kFarthest_m at most; negative: the
  // greatest overlap.
  double least_m = kFarthest_m;
  std::string obstacle;     // which; empty where all are farther
  Vec2 p_W = Vec2::Zero();  // of the robot's centre, there
  double along_m = 0;
  std::vector<PlanConflict> conflicts;  // the greatest overlap first
  std::vector<PlanCrossing> crossings;  // one a level change, in the order of the way

  static constexpr double kFarthest_m = 1;
};

// Moves the robot's own outline (RobotSpec::outline_B; blocks where it folds) along the plan:
// straight from waypoint to waypoint, with the plan's yaw where its drive holds one, else heading
// along the way, turning and folding where it stands. It is compared with the known
// floor: walls as they are built, drawn back by `inset_m`, and the polygons of the hazards that the
// robot must keep off (IsObstacle), whatever their cells. What overlaps by less than a millimetre
// touches. A level change that the plan's line meets (LevelChangesOnTheWay) is crossed, and no
// obstacle but where the robot's side alone reaches over its edge. Not checked: how far a tracker
// leaves the plan, also in bends.
PlanClearance CheckClearance(const World& world, const PlanResult& plan);

}  // namespace floorproof
