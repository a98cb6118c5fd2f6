// SPDX-License-Identifier: Apache-2.0
// First orders, for others to improve: by nearest neighbours, and by the shortest edges.
#pragma once

#include <vector>

#include "planners/orders/visit_order.h"

namespace floorproof {

// From the start always on to the nearest place that is left; ties by place number.
std::vector<int> NearestNeighbourOrder(const PlaceDistances& distances);

// The shortest edges first that make neither a third edge at a place nor a cycle, until all places
// are on one way (Bentley, "Fast Algorithms for Geometric Traveling Salesman Problems", 1992). The
// start has one edge only. Ties by place numbers. It takes memory for all n (n - 1) / 2 edges.
std::vector<int> GreedyOrder(const PlaceDistances& distances);

}  // namespace floorproof
