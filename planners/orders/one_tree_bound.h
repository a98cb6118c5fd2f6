// SPDX-License-Identifier: Apache-2.0
// How short an order of visit can be at best: a proven lower bound by 1-trees.
#pragma once

#include "planners/orders/visit_order.h"

namespace floorproof {

// No order is shorter than this (m), not even by TourLength's rounding. `known_m`: the length of
// some order, which the steps are measured by; it need not be short. `iterations`: spanning trees
// that are made at most, of O(n^2) each.
double OneTreeBound(const PlaceDistances& distances, bool closed, double known_m, int iterations);

}  // namespace floorproof
