// SPDX-License-Identifier: Apache-2.0
// What planners by risk share: they go from cell to cell of the risk's own grid, from the start's
// cell to the goal's. Each cell is as wide as the robot.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "planners/planner.h"
#include "planners/risk/risk_map.h"
#include "planners/risk/terrain_yaw.h"
#include "planners/walk/transform_tour.h"

namespace floorproof {

struct CellTask {
  const RiskMap& risk;
  Cell start, end;
  Grid<std::uint8_t> free;      // free cells that can be reached over floor and terrain
  Grid<std::uint8_t> drivable;  // these and the terrain that can be reached
};

class CellPlanner : public Planner {
 public:
  void Visit(ParamVisitor& visit) override;
  // Without a goal the path ends on the free cell with the longest way from the start. Neither
  // start nor goal may lie on a hazard. Free cells to which neither floor nor terrain leads are
  // left out as long as they are few (`unreachable_share`); else the floor is divided:
  // kFloorDivided.
  PlanResult Plan(const PlanRequest& request) const override;
  PlannerPromises promises() const override {
    return {.covers = PlannerPromises::Covers::kCells,
            .least_coverage = 0.8,
            .needs_risk = true,
            .ends_at_goal = true};
  }

 protected:
  using Figures = std::vector<std::pair<std::string, double>>;
  // A tour from task.start to task.end over cells of task.drivable.
  virtual CellTour Tour(const CellTask& task, Figures& figures) const = 0;
  // Whether it crosses terrain in the way that suits the robot best, as far as the model states
  // that (RobotSpec's cover limits): fast, and forward if the robot is holonomic (terrain_yaw.h).
  virtual bool crosses_with_care() const { return false; }
  // What a holonomic robot crosses terrain with.
  virtual TerrainLead terrain_lead(const RobotSpec& robot) const;

  double unreachable_share_ = 0.05;
};

}  // namespace floorproof
