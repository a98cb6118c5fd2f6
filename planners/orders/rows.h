// SPDX-License-Identifier: Apache-2.0
// The zig-zag over places: row by row along y, to and fro along x.
#pragma once

#include <vector>

#include "planners/orders/visit_order.h"

namespace floorproof {

// A row begins with the least y that is left and holds all places up to `row_m` above it. Rows are
// gone through from the least y on, by turns with x ascending and descending; the first one from
// the end that is nearer to the start by `distances` (a tie: the lesser x). Ties by place number.
std::vector<int> OrderByRows(const OrderRequest& request, double row_m);

}  // namespace floorproof
