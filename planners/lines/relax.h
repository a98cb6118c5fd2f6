// SPDX-License-Identifier: Apache-2.0
// Relaxing: a path's points and legs are shifted to where the path is shorter, or sweeps more.
#pragma once

#include "planners/lines/swept.h"

namespace floorproof {

struct RelaxOptions {
  double goal_cells;        // of ground: less than this is not left
  double worth;             // a length must sweep this share of width * length, or it is drawn in
  double coarsest, finest;  // steps, cells; each is half of the one before
};

// The first point stays, and so does the order of the others. `swept` holds the path, before and
// after.
void Relax(const Floor& floor, const RelaxOptions& options, Polyline& path, Swept& swept);

}  // namespace floorproof
