// SPDX-License-Identifier: Apache-2.0
// The expected rate of failures of a visit to each cell of the risk's grid.
#pragma once

#include "planners/risk/path_rates.h"

namespace floorproof {

// Terrain: of crossing its hazards at right angles, in the best of the speeds and with the best of
// the sides leading, spread over the cells that a crossing takes. Free cells: of passing along the
// hazards within reach. A sum over a walk's visits is about what the walk will be expected to meet:
// where a hazard lies in its cell is left out, and 1 stands for terrain of which nothing was
// measured.
Grid<double> CellRates(const PlanRequest& request, const PathRates& rates);

}  // namespace floorproof
