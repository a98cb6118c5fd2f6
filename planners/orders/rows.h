// SPDX-License-Identifier: Apache-2.0
// Places by y; and the zig-zag over them: row by row along y, to and fro along x.
#pragma once

#include <vector>

#include "planners/orders/visit_order.h"

namespace floorproof {

// The start, then the places by growing y, of equals the lesser x first; ties by place number.
std::vector<int> OrderByY(const OrderRequest& request);

// A row begins with the least y that is left and holds all places up to `row_m` above it. Rows are
// gone through from the least y on, by turns with x ascending and descending; the first one from
// the end that is nearer to the start by `distances` (a tie: the lesser x). Ties by place number.
std::vector<int> OrderByRows(const OrderRequest& request, double row_m);

}  // namespace floorproof
