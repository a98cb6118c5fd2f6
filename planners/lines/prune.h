// SPDX-License-Identifier: Apache-2.0
// Takes those detours out of a path that are not worth their length.
#pragma once

#include "planners/lines/swept.h"

namespace floorproof {

struct PruneOptions {
  double goal_cells = 0;  // swept cells never fall below this
  double worth = 0.3;     // a detour stays when it sweeps more than this share of width * length
  int passes = 2;         // over the path, with `worth` rising to the value above
};

// Shortens `path` (its first point stays); `swept` holds the path and is kept up to date.
void Prune(const Floor& floor, const PruneOptions& options, Polyline& path, Swept& swept);

}  // namespace floorproof
