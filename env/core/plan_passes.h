// SPDX-License-Identifier: Apache-2.0
// Where a tool passes along a plan that is driven exactly.
#pragma once

#include "env/core/coverage.h"

namespace floorproof {

// The meter after the whole path; `area` outlives it. A waypoint without a yaw keeps the last, the
// map's own at first.
CoverageMeter PassesOf(const SweepArea& area, const Shape2& tool, const Path& path);

}  // namespace floorproof
