// SPDX-License-Identifier: Apache-2.0
// Wall contours: lines along walls and furniture, traced around the robot's poses.
#pragma once

#include "planners/lines/swept.h"

namespace floorproof {

// Distance from each pose cell's centre to the nearest cell that is none, cells.
Grid<float> PoseDepth(const Floor& floor);

// Closed contours (first point = last) of the poses at least `depth` deep, walls to the right.
std::vector<Polyline> Contours(const Floor& floor, const Grid<float>& depth, double least_depth);

// The parts of `lines` where at least `share` of the tool's width is still open, in the order
// given. Each is added to `swept` at once, so that no later line sweeps it again. Parts that gain
// less than `min_gain` cells are left out. They are simplified within `tolerance` cells.
std::vector<Polyline> OpenParts(const Floor& floor, const std::vector<Polyline>& lines,
                                double share, double min_gain, double tolerance, Swept& swept);

// The line with fewer points: none of the old ones is farther than `tolerance` from it, and the
// robot can drive each of its segments.
Polyline Simplify(const Floor& floor, const Polyline& line, double tolerance);

}  // namespace floorproof
