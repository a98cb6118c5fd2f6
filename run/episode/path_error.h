// SPDX-License-Identifier: Apache-2.0
// Where a robot is beside its plan.
#pragma once

#include "env/core/coverage.h"
#include "env/core/path.h"

namespace floorproof {

// From the segment from waypoint `segment` to the next, the way to p_W, m.
Vec2 OffTrack(const Path& path, std::size_t segment, const Vec2& p_W);

// Half the free width across that segment beside p_W, m: from the path to the obstacles on both
// sides, each looked for as far as 1 m.
double HalfWidth(const ClearanceField& clearance, const Path& path, std::size_t segment,
                 const Vec2& p_W);

}  // namespace floorproof
