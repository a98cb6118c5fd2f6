// SPDX-License-Identifier: Apache-2.0
// The size up to which something is crossed, found by a ladder of rungs and bisection.
#pragma once

#include <functional>
#include <optional>

namespace floorproof {

// Sizes tried, as whole numbers of the resolution: exact, so that limits read as they are meant.
struct Rungs {
  int per_unit = 1;  // the resolution is 1 / per_unit of the unit that sizes are written in
  int first = 1;     // the lowest rung, resolutions
  int spacing = 1;   // from rung to rung, resolutions
  int last = 1;      // the highest rung at most, resolutions
};

struct Limit {
  double size = 0;  // the largest crossed below the first rung that is not; 0: the first is not
  bool above_all = false;  // every rung is crossed: the limit lies at `size` or above
};

// Climbs the rungs from the smallest. The first that fails ends the climb, and the limit is found
// by bisection between it and the rung below. What might be crossed above that does not count: a
// limit says up to where everything is crossed. Between two rungs the outcome is taken to be
// monotone; over all rungs it need not be. Nothing when interrupted.
std::optional<Limit> FindLimit(const Rungs& rungs, const std::function<bool(double size)>& crosses);

}  // namespace floorproof
