// SPDX-License-Identifier: Apache-2.0
// A walk from cell to cell with the least sum of expected rates of failure.
#pragma once

#include "planners/risk/cell_planner.h"

namespace floorproof {

class RateWalk final : public CellPlanner {
 public:
  struct Options {
    bool fewest_crossings = true;  // of terrain, before all else; else the sum alone counts
    TerrainLead lead = TerrainLead::kAny;
    double unreachable_share = 1;  // as CellPlanner's key
    double effort = 1;             // of the search (CoverWalkOptions)
  };
  // `rates`: of a visit to each cell (cell_rates.h); outlives it.
  RateWalk(const Grid<double>& rates, const Options& options);

 protected:
  TerrainLead terrain_lead(const RobotSpec&) const override { return options_.lead; }
  CellTour Tour(const CellTask& task, Figures& figures) const override;

 private:
  const Grid<double>& rates_;
  Options options_;
};

}  // namespace floorproof
