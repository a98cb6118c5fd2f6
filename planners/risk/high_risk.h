// SPDX-License-Identifier: Apache-2.0
// The floor that the FMEA paper's planner covers: the free cells without those of high risk, and
// terrain where it has to be crossed.
#pragma once

#include <optional>

#include "planners/risk/cell_planner.h"

namespace floorproof {

// Section 2.3: cells of high risk count as obstacles. They are 15 % of all cells within the outer
// walls, hazards included, where there are level changes, and 3 % where there are none.
struct HighRiskParams {
  std::optional<double> share;  // none: the paper's
  void Visit(ParamVisitor& visit);
};

struct LowRisk {
  Grid<std::uint8_t> open;  // free cells to be covered, and terrain opened
  Grid<double> wave;        // scores from the end over these (WaveOverTerrain)
  int high_risk_cells = 0;  // free cells left out for their risk
  int cut_off_cells = 0;    // free cells of low risk that those cut off
  int opened_cells = 0;     // of terrain
};

// Start and end are always in it. Where cells of high risk would cut the end off from the start,
// the ones with the least sum of RF between the two are kept as floor. What else they cut off is
// left out: that is what the paper trades for safety.
LowRisk LowRiskFloor(const CellTask& task, const HighRiskParams& params);

}  // namespace floorproof
