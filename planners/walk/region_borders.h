// SPDX-License-Identifier: Apache-2.0
// How many borders between regions a way has to cross.
#pragma once

#include <cstdint>
#include <vector>

#include "planners/walk/walk_graph.h"

namespace floorproof {

class RegionBorders {
 public:
  explicit RegionBorders(const WalkGraph& graph);

  // By region, borders on the way to `to`: as many as there are from `from` and from all that are
  // no farther, at least as many from others. Valid until the next call.
  const std::uint16_t* To(int to, int from);

  std::int64_t work = 0;  // regions looked at

 private:
  const WalkGraph& graph_;
  std::size_t regions_;
  std::vector<std::uint16_t> borders_;  // rows, by region
  std::vector<int> row_region_;         // by row; -1: none yet
  std::vector<int> depth_;              // by row: up to where it is exact
  std::vector<int> reached_;
};

}  // namespace floorproof
