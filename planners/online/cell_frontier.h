// SPDX-License-Identifier: Apache-2.0
// Coverage cell by cell along the frontier of what is covered, looking ahead.
//
// The rule: go to the uncovered cell beside the robot that has the fewest uncovered neighbours; a
// turn counts as one and a half more, a diagonal step as six. At a dead end go the cheapest way to
// an uncovered cell. So the robot winds along walls and lanes, yet it runs into dead ends that it
// could have seen. Hence each cell beside the robot is tried: from there the rule is driven in
// thought until all is covered within some cells around the robot (look_ahead.h), and the cell
// after which the way is cheapest is taken. Unknown floor is thought to be free. It is driven to
// its end: broken off, it would prefer what puts dead ends off.
//
// The way that was found is kept as a plan, and tried again from the next cell: only one that is
// better by two steps takes its place. What is thought of the unknown is a guess, and changes of
// mind for its sake would be, too. (In the paper that look_ahead.h names: a fortified rollout.)
//
// A way costs its length beyond a straight step for each uncovered cell, and much more for each
// cell that is covered for the second time. Cells covered twice already cost no more than their
// length; a diagonal step to an uncovered cell costs double what it is longer.
// Ours. Assumed: r is at least a step. Not done: choosing a way out by what lies behind its end:
// what is thought to lie there is too uncertain, and J_cc rises. So much is tried before a step and
// no more (LookAhead); but where all is covered but something far away, the way out is searched for
// over all of the known floor.
#pragma once

#include <optional>
#include <vector>

#include "planners/online/look_ahead.h"
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
  int Best(int at, int by_rule);

  RobotCells cells_;
  ThoughtFloor floor_;
  std::optional<LookAhead> ahead_;
  std::optional<Cell> here_;
  int heading_ = ThoughtFloor::kNone;
  std::vector<int> route_;  // steps; the next is the last
  // What it is about to do, as steps from a cell; the next is the first.
  std::vector<int> plan_;
  std::optional<Cell> planned_from_;
  double dead_ends_ = 0;
};

}  // namespace floorproof
