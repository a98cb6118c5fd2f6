// SPDX-License-Identifier: Apache-2.0
// What planners from cell to cell of an unknown floor have in common.
#pragma once

#include <optional>

#include "base/params.h"
#include "planners/online/online_planner.h"
#include "planners/online/robot_cells.h"

namespace floorproof {

struct CellParams {
  double radius_m = 1.5;         // r
  std::optional<double> step_m;  // epsilon
  void Visit(ParamVisitor& v) {
    v("radius_m", radius_m, Positive(), "r: how far the robot sees around it, at least a step (m)");
    v("step_m", step_m, Positive(),
      "epsilon: side of its cells (m); none: the tool's width, or the site's cell (drive: cells)");
  }
  RobotCells Cells(const OnlineTask& task) const {
    return {task.ground, task.start.p(), step_m.value_or(task.tool_width_m), task.keep_clear_m};
  }
};

}  // namespace floorproof
