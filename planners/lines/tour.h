// SPDX-License-Identifier: Apache-2.0
// In which order, and in which direction each, to drive a set of lines: a short tour over them.
#pragma once

#include "planners/lines/shortest_paths.h"

namespace floorproof {

struct Stop {
  std::size_t line = 0;
  bool reversed = false;
};

// An open tour from `start` over all lines. `thorough`: with kicks
// (planners/search/local_search.h), which shorten the ways between lines by some per cent more.
std::vector<Stop> OrderLines(ShortestPaths& paths, const Vec2& start,
                             const std::vector<Polyline>& lines, bool thorough = true);

}  // namespace floorproof
