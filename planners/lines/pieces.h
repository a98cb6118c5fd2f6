// SPDX-License-Identifier: Apache-2.0
// A path taken apart again, so that its working parts can be put into a better order.
#pragma once

#include "planners/lines/swept.h"

namespace floorproof {

// The parts of `path` that sweep something: runs of segments, cut at those that sweep less than
// `share` of their own width * length. `swept` holds the path before and the pieces after.
std::vector<Polyline> WorkingPieces(const Floor& floor, const Polyline& path, double share,
                                    Swept& swept);

// Cuts `pieces` where an end of one of `lines` lies beside them, nearer than `reach` and in sight.
// So the tour can leave the piece there to visit the line.
void CutBeside(const Floor& floor, const std::vector<Polyline>& lines, double reach,
               std::vector<Polyline>& pieces);

}  // namespace floorproof
