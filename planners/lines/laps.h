// SPDX-License-Identifier: Apache-2.0
// Lines along walls and furniture: contours of the floor's poses.
#pragma once

#include "planners/lines/swept.h"

namespace floorproof {

// Distance from each pose cell's centre to the nearest cell that is none, cells.
Grid<float> PoseDepth(const Floor& floor);

// Closed contours (first point = last) of the poses at least `depth` deep, walls to the right.
std::vector<Polyline> Contours(const Floor& floor, const Grid<float>& depth, double least_depth);

// The parts of `lines` where at least `share` of the tool's width is still open, in the order
// given; each is added to `swept` at once, so that a later line does not sweep it again. Parts that
// gain less than `min_gain` cells are left out. Simplified within `tolerance` cells.
std::vector<Polyline> OpenParts(const Floor& floor, const std::vector<Polyline>& lines,
                                double share, double min_gain, double tolerance, Swept& swept);

// Fewer points, none farther than `tolerance` from the line, all straight runs in sight.
Polyline Simplify(const Floor& floor, const Polyline& line, double tolerance);

}  // namespace floorproof
