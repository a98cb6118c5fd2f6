// SPDX-License-Identifier: Apache-2.0
// Coverage cell by cell along the frontier of what is covered, looking ahead.
//
// The rule: go to the uncovered cell beside the robot that has the fewest uncovered neighbours; a
// diagonal step counts as three more, and straight on wins where equal. At a dead end go the
// cheapest way to an uncovered cell. So the robot winds along walls and lanes, yet it runs into
// dead ends that it could have seen. Hence, where there is a choice, each cell beside the robot is
// tried: from there the rule is driven in thought until all is covered within some cells around the
// robot, and the cell after which dead ends cost least is taken. Unknown floor is thought to be
// free. (A rollout: Bertsekas, Tsitsiklis & Wu, "Rollout algorithms for combinatorial
// optimization", 1997.) It is driven to its end, on a small part of the floor: broken off, it would
// prefer what puts dead ends off.
//
// A way out of a dead end costs its length, and much more for each cell that is covered for the
// second time on it. Cells covered twice already cost no more than their length.
// Ours. Assumed: r is at least a step. Not done: choosing a way out by what lies behind its end.
// Where all is covered but something far away, the way out is searched for over all of the known
// floor.
#pragma once

#include <optional>
#include <vector>

#include "planners/online/online_planner.h"
#include "planners/online/robot_cells.h"
#include "planners/online/thought_floor.h"

namespace floorproof {

class CellFrontier {
 public:
  // `look_around`: cells; 0: the rule alone.
  CellFrontier(const OnlineTask& task, const OnlineParams& params, int look_around);

  OnlineStep Next(const OnlineInput& input);
  double dead_ends() const { return dead_ends_; }

 private:
  int Choose(int at);
  void NotThatWay(int at, std::size_t step);
  int LookAhead(int at, int by_rule);

  int look_around_;
  RobotCells cells_;
  ThoughtFloor floor_;
  std::optional<Cell> here_;
  int heading_ = ThoughtFloor::kNone;
  std::vector<int> route_;  // steps; the next is the last
  double dead_ends_ = 0;
};

}  // namespace floorproof
