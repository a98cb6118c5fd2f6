// SPDX-License-Identifier: Apache-2.0
// The conventional path transform (Zelinsky 1994; Dakulovic, Horvatic & Petrovic 2011, the hTetro
// FMEA paper's reference 31), which is that paper's baseline.
//
// The robot goes from cell to cell, always to the unvisited neighbour that is farthest from the
// end. How far a cell is from the end: the least sum, over all paths there, of the path's length
// and the cost of being near solid obstacles (C1 to C3). Terrain is driven like any floor. The
// wave: planners/walk/wave_front.h; the order: planners/walk/transform_tour.h.
#include <cmath>

#include "env/core/coverage.h"
#include "env/geometry/distance.h"
#include "planners/risk/cell_planner.h"
#include "planners/risk/high_risk.h"
#include "planners/walk/wave_front.h"

namespace floorproof {
namespace {

class PathTransform final : public CellPlanner {
 public:
  void Visit(ParamVisitor& visit) override {
    CellPlanner::Visit(visit);
    visit("obstacle_weight", obstacle_weight_, Between(0, kMaxWeight),
          "score of a cell beside a solid obstacle; a step scores 15");
    visit("obstacle_reach", obstacle_reach_, NonNegative(),
          "cells from a solid obstacle at which its cost has fallen to 0, in equal steps");
    visit("cells", cells_, {"all", "free", "fmea"},
          "all; or free ones, and terrain only where it must be crossed; or those alone that "
          "fmea_path_transform visits: what of its risk is order, and what is cells left out");
    high_risk_.Visit(visit);
  }

 protected:
  CellTour Tour(const CellTask& task, Figures&) const override {
    Grid<std::uint8_t> open = task.drivable;
    if (cells_ == "free") open = LowRiskFloor(task, {.share = 0}).open;
    if (cells_ == "fmea") open = LowRiskFloor(task, high_risk_).open;
    const Grid<std::uint8_t> solid = CellsThat(task.risk.grid, &RiskCell::solid);
    const Grid<float> distance = DistanceToSet(solid, true);  // 0.5 beside one
    const Grid<double> score = WaveFront(open, task.end, [&](Cell c) {
      const double away = static_cast<double>(distance(c)) - 0.5;
      return away < obstacle_reach_ ? obstacle_weight_ * (1 - away / obstacle_reach_) : 0;
    });
    return TransformTour(open, score, task.start, task.end);
  }

 private:
  double obstacle_weight_ = 15;
  double obstacle_reach_ = 2;
  std::string cells_ = "all";
  HighRiskParams high_risk_;
};

}  // namespace

FP_DEFINE_PLUGIN(Planner, PathTransform)

}  // namespace floorproof
