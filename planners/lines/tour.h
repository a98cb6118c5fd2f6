// SPDX-License-Identifier: Apache-2.0
// The order and sense in which to drive a set of lines so that the ways between them are short.
#pragma once

#include "planners/lines/ways.h"

namespace floorproof {

struct Stop {
  std::size_t line = 0;
  bool reversed = false;
};

// An open tour from `start` over all lines. `thorough`: with iterated local search, which shortens
// the links by some per cent more.
std::vector<Stop> OrderLines(Ways& ways, const Vec2& start, const std::vector<Polyline>& lines,
                             bool thorough = true);

}  // namespace floorproof
