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
// Linear in the hazard cells, hence one convolution: O(cells log cells), whatever their number.
// `walls_are_hazards`: outer walls count as C1; the ring of cells within the map where it is walled
// all round, else a ring of cells around it.
// RF is rounded to 1e-14 of what all hazards in one place would sum to, so that places that are
// alike have the same.
RiskMap ComputeRisk(const HazardMap& map, const RobotSpec& robot, const FmeaTables& tables,
                    const RiskParams& params = {});

}  // namespace floorproof
