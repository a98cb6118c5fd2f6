// SPDX-License-Identifier: Apache-2.0
// Coverage by risk, our own: the risk is that of the hTetro FMEA paper, but the cells are put in
// the order with the least sum.
//
// The cumulative RF of a path has two parts: the RF of all its cells once, which no order can
// change, and the RF of the cells that it visits again. The second part is what is searched for
// (planners/walk/cover_walk.h): as few crossings of terrain as possible, then the least of RF and
// steps in equal parts. Terrain is crossed at right angles, away from walls where that costs no
// more than a step, and at the speed and heading that suit the robot best (RobotSpec's cover
// limits). `cells: fmea` covers the cells that fmea_path_transform covers, `all` every free cell
// that can be reached. Not done: counting turns.
#include <algorithm>
#include <string>

#include "planners/risk/high_risk.h"
#include "planners/walk/cover_walk.h"

namespace floorproof {
namespace {

// A visit of terrain counts as a step more, so that terrain is crossed straight. Beside a wall it
// counts as two more: robots slow down there, and a slow robot is held by covers that a fast one
// crosses.
Grid<double> StepsMore(const RiskGrid& grid, bool avoid_walls) {
  Grid<double> more(grid.contents.width, grid.contents.height);
  const auto solid = [&](Cell c) { return !grid.contents.Inside(c) || grid.contents(c).solid; };
  for (std::size_t i = 0; i < more.cells.size(); ++i) {
    if (!grid.contents.cells[i].terrain()) continue;
    const Cell cell = CellAt(more, i);
    const auto beside_solid = [&](Cell step) { return solid(cell + step); };
    const bool tight = std::ranges::any_of(kSideSteps, beside_solid) ||
                       std::ranges::any_of(kCornerSteps, beside_solid);
    more.cells[i] = avoid_walls && tight ? 2 : 1;
  }
  return more;
}

class RiskCoverage final : public CellPlanner {
 public:
  void Visit(ParamVisitor& visit) override {
    CellPlanner::Visit(visit);
    visit("cells", cells_, {"all", "fmea"},
          "all free cells, or those alone that fmea_path_transform visits");
    visit("risk_share", options_.cost_share, Between(0, 1),
          "of RF in what is minimised; the rest is steps, and keeping crossings off walls");
    visit("effort", options_.effort, Between(0, 100),
          "of the search; 1: half a second for 40,000 cells");
    high_risk_.Visit(visit);
  }

 protected:
  bool crosses_with_care() const override { return true; }

  CellTour Tour(const CellTask& task, Figures& figures) const override {
    CoverWalkProblem problem;
    problem.start = task.start;
    problem.end = task.end;
    problem.open = task.drivable;
    problem.required = task.free;
    if (cells_ == "fmea") problem.open = problem.required = LowRiskFloor(task, high_risk_).open;
    problem.terrain = CellsThat(task.risk.grid, &RiskCell::terrain);
    problem.cost = task.risk.rf;
    // Where the paper's cells are given, so is where terrain is crossed.
    problem.more_steps = StepsMore(task.risk.grid, cells_ == "all");
    // Where nothing is a risk steps alone count.
    const bool no_risk = std::ranges::none_of(problem.cost.cells, [](double rf) { return rf > 0; });
    if (no_risk) std::ranges::fill(problem.cost.cells, 1);
    const CoverWalkBound bound = BoundCoverWalk(problem);
    const CoverWalk walk = ShortCoverWalk(problem, options_);
    double risk = 0;
    for (const Cell cell : walk.cells) risk += task.risk.rf(cell);
    figures.push_back(
        {"risk_bound", no_risk ? 0 : std::min(bound.cost, risk)});  // but for rounding
    figures.push_back({"steps_bound", static_cast<double>(bound.steps)});
    CellTour tour;
    tour.cells = walk.cells;
    return tour;
  }

 private:
  std::string cells_ = "all";
  CoverWalkOptions options_;
  HighRiskParams high_risk_;
};

}  // namespace

FP_DEFINE_PLUGIN(Planner, RiskCoverage)

}  // namespace floorproof
