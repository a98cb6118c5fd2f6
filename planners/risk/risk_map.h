// SPDX-License-Identifier: Apache-2.0
// The risk factor (RF) of every place, after the hTetro FMEA paper (Eqs. 1 to 4).
#pragma once

#include <optional>

#include "planners/risk/risk_grid.h"

namespace floorproof {

struct RiskParams {
  std::optional<double> cell_m;
  double distance_scale = 1;
  bool walls_are_hazards = false;
  void Visit(ParamVisitor& visit);
};

struct RiskMap {
  RiskGrid grid;
  Grid<double> rf;  // on grid.frame; of a wall's or hazard's own cell too
};

// RF(x) = sum over hazard cells H of class C of
//   2 Weight(C) / (20 + distance_scale * |x - x_H|), distances from centre to centre in cells.
// RF is linear in the hazard cells. So it is one convolution, which takes O(cells log cells)
// however many hazards there are. `walls_are_hazards`: outer walls count as C1. They are the
// outermost ring of cells if the map is walled all round, else a ring of cells around the map. RF
// is rounded, to 1e-14 of what all hazards would sum to in one place, so that places that are alike
// have the same RF.
RiskMap ComputeRisk(const HazardMap& map, const RobotSpec& robot, const FmeaTables& tables,
                    const RiskParams& params = {});

}  // namespace floorproof
