// SPDX-License-Identifier: Apache-2.0
#include "planners/risk/rate_walk.h"

#include <algorithm>

#include "planners/walk/cover_walk.h"

namespace floorproof {

RateWalk::RateWalk(const Grid<double>& rates, const Options& options)
    : rates_(rates), options_(options) {
  unreachable_share_ = options.unreachable_share;
}

CellTour RateWalk::Tour(const CellTask& task, Figures&) const {
  // A certain failure costs as much as driving all over the floor so often.
  constexpr double kFloorsAFailure = 100;
  CoverWalkProblem problem;
  problem.start = task.start;
  problem.end = task.end;
  problem.open = task.drivable;
  problem.required = task.free;
  const Grid<std::uint8_t> terrain = CellsThat(task.risk.grid, &RiskCell::terrain);
  problem.terrain = terrain;
  if (!options_.fewest_crossings) std::ranges::fill(problem.terrain.cells, 0);
  problem.cost = Grid<double>(rates_.width, rates_.height);
  std::ranges::fill(problem.cost.cells, 1);
  const double steps_a_rate =
      kFloorsAFailure * static_cast<double>(std::ranges::count(task.free.cells, 1));
  problem.more_steps = rates_;
  for (std::size_t i = 0; i < rates_.cells.size(); ++i)
    problem.more_steps.cells[i] = steps_a_rate * rates_.cells[i] + terrain.cells[i];
  CellTour tour;
  tour.cells = ShortCoverWalk(problem, {.cost_share = 0, .effort = options_.effort}).cells;
  return tour;
}

}  // namespace floorproof
