// SPDX-License-Identifier: Apache-2.0
// Coverage by risk: the planner of the hTetro FMEA paper (section 2.3). Cells of high risk count as
// obstacles. The robot goes from cell to cell, always to the unvisited neighbour of the highest
// score. The score grows with the distance from the end and falls with risk.
//
// Algorithm 1 as printed scores a step 15 or 20 less 2 RF, and begins at the start. The text and
// Eq. 5 say otherwise. The wave begins at the end. Its scores of 15 and 20 add up along the way. A
// cell's total is that sum less K = 50 times its RF, normalised by RF_min and RF_max "for the
// environment": of all cells within the outer walls, hazards included. Algorithm 2 needs scores
// that say how far the end is, and only the second reading gives them, so it is what is built.
// With this K totals near the end of the wave are below 0, where the paper wants TotalScore > 0.
// That does no harm: an order does not change by what is added to all.
// The wave: planners/risk/terrain_wave.h; the cells: planners/risk/high_risk.h; the order:
// planners/walk/transform_tour.h.
#include <algorithm>
#include <limits>

#include "planners/risk/high_risk.h"
#include "planners/risk/terrain_wave.h"

namespace floorproof {
namespace {

class FmeaPathTransform final : public CellPlanner {
 public:
  void Visit(ParamVisitor& visit) override {
    CellPlanner::Visit(visit);
    visit("risk_weight", risk_weight_, Between(0, kMaxWeight), "K of Eq. 5; a step scores 15");
    high_risk_.Visit(visit);
  }

 protected:
  CellTour Tour(const CellTask& task, Figures& figures) const override {
    const LowRisk floor = LowRiskFloor(task, high_risk_);
    figures.push_back({"high_risk_cells", floor.high_risk_cells});
    figures.push_back({"cut_off_cells", floor.cut_off_cells});
    figures.push_back({"opened_cells", floor.opened_cells});
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t i = 0; i < floor.open.cells.size(); ++i)
      if (!task.risk.grid.contents.cells[i].outer_wall()) {
        low = std::min(low, task.risk.rf.cells[i]);
        high = std::max(high, task.risk.rf.cells[i]);
      }
    Grid<double> total = floor.wave;
    for (std::size_t i = 0; i < total.cells.size(); ++i)
      if (high > low) total.cells[i] -= risk_weight_ * (task.risk.rf.cells[i] - low) / (high - low);
    return TransformTour(floor.open, total, task.start, task.end);
  }

 private:
  double risk_weight_ = 50;
  HighRiskParams high_risk_;
};

}  // namespace

FP_DEFINE_PLUGIN(Planner, FmeaPathTransform)

}  // namespace floorproof
