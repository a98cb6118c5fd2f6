// SPDX-License-Identifier: Apache-2.0
// Coverage of an unknown floor in lanes of the tool's width, along the frontier of what is swept.
//
// From where the robot is, short ways of two legs in the eight directions are tried in thought. The
// best has the most new floor under the tool for its length, the frontier along its sides, so that
// no strip is left between lanes, and few turns. Its next leg is driven; then it is tried anew.
// Where none has much new floor the robot goes the shortest way to the nearest place that has.
// Ours. Assumed: lanes need not be straight, nor end where others begin. Not done: thinking further
// than two legs; strips that are too narrow to be worth their way.
#pragma once

#include <optional>
#include <vector>

#include "planners/online/online_planner.h"
#include "planners/online/tool_floor.h"

namespace floorproof {

class LaneFrontier {
 public:
  explicit LaneFrontier(const OnlineTask& task);

  OnlineStep Next(const OnlineInput& input);
  double dead_ends() const { return dead_ends_; }

 private:
  struct Legs {
    double value = 0;
    Cell first;        // where the first leg ends
    int heading = -1;  // of it, a step of kSteps
  };
  void Sweep(const OnlineInput& input);
  // Leaves out legs that end where the robot is.
  void PopReached();
  Legs BestLegs(Cell from) const;
  struct Tried;
  void Go(std::size_t step, int most, Tried& way) const;

  ToolFloor floor_;
  double width_;  // of the tool, cells
  std::optional<Vec2> here_W_, before_W_;
  int heading_ = -1;
  std::vector<ToolFloor::Leg> route_;  // to the nearest open place; the next leg is the last
  double dead_ends_ = 0;
};

}  // namespace floorproof
