// SPDX-License-Identifier: Apache-2.0
// The shortest order of few places.
#pragma once

#include <vector>

#include "planners/orders/visit_order.h"

namespace floorproof {

inline constexpr int kMaxExactPlaces = 12;

// No order is shorter. Of at most kMaxExactPlaces: it takes 2^n n^2 steps.
std::vector<int> ExactOrder(const PlaceDistances& distances, bool closed);

}  // namespace floorproof
