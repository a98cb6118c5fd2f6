// SPDX-License-Identifier: Apache-2.0
// Short lines over what other lines left open.
#pragma once

#include "planners/lines/swept.h"
#include "planners/lines/ways.h"

namespace floorproof {

// Lines through clusters of open ground of at least `min_cells`, each added to `swept`.
std::vector<Polyline> LinesOverLeftovers(const Floor& floor, const Ways& ways, double min_cells,
                                         Swept& swept);

}  // namespace floorproof
